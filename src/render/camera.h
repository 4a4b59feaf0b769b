// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "leafhull/vec.h"

namespace leafhull::render {

/// A pinhole camera with a long lens, slightly above the tree.
struct Camera {
  Vec3f eye, right, up, forward;
  float tan_x, tan_y;  ///< of half the angle of view

  /// The direction through (x, y), both 0..1 over the picture, from its top left; not normalised.
  Vec3f direction(float x, float y) const {
    return forward + right * ((2 * x - 1) * tan_x) + up * ((1 - 2 * y) * tan_y);
  }
};

/// The camera whose picture of `aspect` (width / height) holds balls of radius `reach` around
/// `points` with `margin`, a part of the picture's width and height, on each side.
Camera frame(std::span<const Vec3f> points, float aspect, float margin = 0.06f, float reach = 0);

}  // namespace leafhull::render
