// SPDX-License-Identifier: Apache-2.0
#include "picture/side_by_side.h"

#include <algorithm>

namespace leafhull {
namespace {

int gap_beside(int width) { return width / 32; }

}  // namespace

int row_width(int width, std::size_t count) {
  const int pictures = static_cast<int>(count);
  return pictures * width + (pictures - 1) * gap_beside(width);
}

Picture side_by_side(std::span<const Picture> pictures) {
  const int width = pictures.front().width, height = pictures.front().height;
  Picture row{row_width(width, pictures.size()), height, {}};
  row.rgb.assign(std::size_t{3} * row.width * height, 255);
  const std::size_t line = std::size_t{3} * width;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const std::size_t column = i * static_cast<std::size_t>(width + gap_beside(width));
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
      std::copy_n(&pictures[i].rgb[y * line], line, &row.rgb[3 * (y * row.width + column)]);
    }
  }
  return row;
}

}  // namespace leafhull
