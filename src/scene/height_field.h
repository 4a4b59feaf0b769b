// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "leafhull/scene.h"

namespace leafhull {

/// Heights interpolated between the pixels of a picture whose corners are those of the area.
class HeightField {
 public:
  /// @throws Error input: the picture cannot be read.
  explicit HeightField(const HeightMap& map);

  /// @param u, v from 0 to 1, to the right and down the picture.
  double at(double u, double v) const;

 private:
  double height_;
  int width_ = 0, rows_ = 0;
  std::vector<std::uint16_t> grey_;
};

}  // namespace leafhull
