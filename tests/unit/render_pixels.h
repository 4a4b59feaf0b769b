// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

#include "leafhull/picture.h"

namespace leafhull {

/// Columns [left, right) and rows [top, bottom).
struct Rectangle {
  int left, top, right, bottom;
};

inline int grey(const Picture& picture, int x, int y) {
  const std::uint8_t* rgb = &picture.rgb[3 * (static_cast<std::size_t>(y) * picture.width + x)];
  return (rgb[0] + rgb[1] + rgb[2]) / 3;
}

/// The smallest rectangle in `window` that holds everything but white; empty if all is white.
inline Rectangle ink_of(const Picture& picture, Rectangle window) {
  Rectangle ink{window.right, window.bottom, window.left, window.top};
  for (int y = window.top; y < window.bottom; ++y) {
    for (int x = window.left; x < window.right; ++x) {
      if (grey(picture, x, y) == 255) continue;
      ink = {std::min(ink.left, x), std::min(ink.top, y), std::max(ink.right, x + 1),
             std::max(ink.bottom, y + 1)};
    }
  }
  return ink;
}

inline Rectangle ink_of(const Picture& picture) {
  return ink_of(picture, {0, 0, picture.width, picture.height});
}

}  // namespace leafhull
