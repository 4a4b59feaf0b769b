// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "input/companions.h"
#include "input/file_bytes.h"
#include "leafhull/tree.h"

namespace leafhull {

/// Tells where the bytes of a picture are, or why there are none.
struct ImageSource {
  std::string name{};   ///< of the picture in the tree; its end tells TGA
  std::string place{};  ///< as warnings call it
  std::string fault{};
  ByteSpan lent{};                ///< of another, who keeps them until they are decoded
  std::function<Bytes()> load{};  ///< or what brings them then, on any thread, or throws FileError
};

/// Looks for a picture beside the file. It is read later, when it is decoded.
ImageSource companion_image(const Companions& companions, const std::string& name,
                            std::vector<std::string>& warnings);

/// The names of a material's colour picture and of its opacity picture. Either may be empty, and
/// both may name the same picture.
using ImageNames = std::pair<std::string, std::string>;

/// The pictures of a tree, each once: numbered as they are asked for, then read and decoded on all
/// threads.
class ImageTable {
 public:
  /// A few bytes can hold many pixels: so many bytes of pixels are kept.
  static constexpr std::size_t kMostBytes = std::size_t{1} << 31;

  explicit ImageTable(std::size_t most_bytes = kMostBytes) : most_bytes_(most_bytes) {}

  /// The number in TreeModel::images, which gets an empty image for it. `load` is asked for every
  /// name that is new.
  int number_of(const ImageNames& names, const std::function<ImageSource(const std::string&)>& load,
                TreeModel& tree);

  /// Fills the images of `tree` in the order of their numbers; its warnings get a line for each
  /// that cannot be read, or would make all of them larger than is kept.
  void decode(TreeModel& tree) const;

 private:
  struct Entry {
    int number;
    std::vector<ImageSource> colour, opacity;  ///< one or none
  };
  struct Decoded;

  static Decoded decode(const Entry& entry);

  std::size_t most_bytes_;
  std::map<ImageNames, int> numbers_;
  std::vector<Entry> entries_;
};

}  // namespace leafhull
