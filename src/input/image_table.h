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

/// The bytes of a picture, or why there are none.
struct ImageSource {
  std::string name{};   ///< of the picture in the tree; its end tells TGA
  std::string place{};  ///< as warnings call it
  std::string fault{};
  ByteSpan lent{};  ///< of another, who keeps them until they are decoded
  Bytes owned{};

  ByteSpan bytes() const { return owned.empty() ? lent : ByteSpan(owned); }
};

/// A picture beside the file.
ImageSource companion_image(const Companions& companions, const std::string& name,
                            std::vector<std::string>& warnings);

/// What a material shows: names of its picture of colour and of that of opacity, either may be
/// empty. Those of one picture alone may be the same.
using ImageNames = std::pair<std::string, std::string>;

/// The pictures of a tree, each once: numbered as they are asked for, then decoded on all threads.
class ImageTable {
 public:
  /// The number in TreeModel::images, which gets an empty image for it. `load` is asked for every
  /// name that is new.
  int number_of(const ImageNames& names, const std::function<ImageSource(const std::string&)>& load,
                TreeModel& tree);

  /// Fills the images of `tree` in the order of their numbers; its warnings get a line for each
  /// that cannot be read, or would make all of them larger than 2 GiB.
  void decode(TreeModel& tree) const;

 private:
  struct Entry {
    int number;
    std::vector<ImageSource> colour, opacity;  ///< one or none
  };
  struct Decoded;

  static Decoded decode(const Entry& entry);

  std::map<ImageNames, int> numbers_;
  std::vector<Entry> entries_;
};

}  // namespace leafhull
