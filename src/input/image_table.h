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
  std::string name{};   ///< the picture's name in the tree; its extension tells TGA
  std::string place{};  ///< its name in warnings
  std::string fault{};
  ByteSpan lent{};                ///< bytes whose owner keeps them until they are decoded
  std::function<Bytes()> load{};  ///< or loads them then, on any thread; throws FileError
};

/// Looks for a picture beside the file. It is read later, when it is decoded.
ImageSource companion_image(const Companions& companions, const std::string& name,
                            std::vector<std::string>& warnings);

/// The names of a material's colour picture and of its opacity picture. Either may be empty, and
/// both may name the same picture.
using ImageNames = std::pair<std::string, std::string>;

/// The pictures of a tree, each once: numbered on request, then read and decoded on all threads.
class ImageTable {
 public:
  /// A few bytes can hold many pixels, so at most this many bytes of pixels are kept.
  static constexpr std::size_t kMostBytes = std::size_t{1} << 31;

  explicit ImageTable(std::size_t most_bytes = kMostBytes) : most_bytes_(most_bytes) {}

  /// The index in TreeModel::images, which gets an empty image for a new picture. `load` is called
  /// for every new name.
  int number_of(const ImageNames& names, const std::function<ImageSource(const std::string&)>& load,
                TreeModel& tree);

  /// Fills the images of `tree` in the order of their numbers. Each one that cannot be read, or
  /// would exceed the total size, adds a line to its warnings.
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
