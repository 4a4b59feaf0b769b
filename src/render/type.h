// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "leafhull/picture.h"

namespace leafhull::render {

/// Open Sans at one size. Characters that it lacks are drawn as its empty box.
class Type {
 public:
  /// `size` is that of the em, pixels.
  explicit Type(float size) : size_(size) {}

  float size() const { return size_; }
  float width(std::string_view label) const;

  /// Draws a label on white, centred on the column `middle`. Parts outside the picture are cut off.
  void draw(std::string_view label, float middle, float baseline, std::uint8_t grey,
            Picture& picture) const;

 private:
  float size_;
};

}  // namespace leafhull::render
