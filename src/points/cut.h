// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <span>
#include <vector>

namespace leafhull {

/// A part of a flat shape.
struct FlatPart {
  Eigen::Vector2d centre;
  Eigen::Matrix2d moments;  ///< second central ones, over its area
  double share = 0;         ///< of the area of the shape
};

/// Cuts a flat shape into parts of about equal area that lie evenly: halves, halved again along
/// their longer side, then a few rounds of Lloyd's method, each part going to the middle of what is
/// nearest to it. On sheets of some hundred parts the sum of kernels of radius 2.5 s around the
/// centres, s^2 being the area of a part, stays within 2.5% of its mean.
/// @param samples points of equal area, in an order of the shape's own; not empty.
/// @param count at least 1; fewer parts come back where there are fewer samples.
std::vector<FlatPart> cut_evenly(std::span<const Eigen::Vector2d> samples, std::size_t count);

}  // namespace leafhull
