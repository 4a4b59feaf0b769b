// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

namespace leafhull {

/// The bounds of the search for R_max, crown units: below the first a kernel is smaller than a
/// voxel of the paper, above the second the crown is one ball.
inline constexpr double kSmallestRadiusMax = 0.75, kLargestRadiusMax = 16;

/// A radius and the dilation that it gives.
struct RadiusFound {
  double radius = 0;     ///< R_max, crown units
  double dilation = 0;   ///< the dilation with this R_max
  bool reached = false;  ///< true: it is the wanted one; false: it is the nearest possible
};

/// Finds the R_max whose dilation is `wanted` to within 0.004, or to within 0.01 if the lattice
/// allows no better; none if no radius that was tried gives a shape. `dilation_at` computes a shape
/// at each call and returns none without one. It rises with the radius, except for the lattice's
/// noise and on compact trees, where it falls again beyond some radius. The search begins at
/// `start` and takes three or four calls, at most sixteen.
std::optional<RadiusFound> find_radius(
    double wanted, double start,
    const std::function<std::optional<double>(double radius)>& dilation_at);

}  // namespace leafhull
