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
  Eigen::Matrix2d moments;  ///< second central moments over its area
  double share = 0;         ///< of the area of the shape
};

/// Cuts a flat shape into evenly spaced parts of about equal area. It halves the shape again and
/// again along the longer side, then takes a few rounds of Lloyd's method, which move each part to
/// the middle of the samples nearest to it. On sheets of some hundred parts, each of area s^2, the
/// sum of kernels of radius 2.5 s around the centres stays within 2.5% of its mean.
/// @param samples points of equal area in an order that depends on the shape alone; not empty.
/// @param count at least 1; fewer parts come back where there are fewer samples.
std::vector<FlatPart> cut_evenly(std::span<const Eigen::Vector2d> samples, std::size_t count);

}  // namespace leafhull
