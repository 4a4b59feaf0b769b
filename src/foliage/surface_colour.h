// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "leafhull/tree.h"

namespace leafhull {

/// The look of a part of a surface, as means over its area.
struct Shown {
  Vec3f colour;       ///< linear, of what is not cut away: texture times factor times vertex colour
  double kept = 1;    ///< the share that is not cut away
  double spread = 0;  ///< variance of the colour in Oklab, a sum over its axes
};

/// Colours of a primitive's triangles. The material's alpha counts where its image has any,
/// whatever its alpha mode says.
class SurfaceColour {
 public:
  /// @param samples about how many looks at the image may be taken for the whole primitive.
  SurfaceColour(const TreeModel& tree, const Primitive& primitive, std::size_t samples);

  Shown of(std::size_t triangle) const;

  /// Whether the colour is more than a program's default.
  bool is_known() const { return is_known_; }
  /// Whether it may differ between triangles.
  bool varies() const { return image_ || !primitive_.colors.empty(); }

 private:
  const Primitive& primitive_;
  const Material* material_ = nullptr;
  const Image* image_ = nullptr;
  int cells_ = 1;  ///< along a triangle's side
  double cutoff_ = 0.5, alpha_ = 1;
  bool is_known_ = false;
};

}  // namespace leafhull
