// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

namespace leafhull {

/// The radii between which R_max is looked for, crown units: below the first a kernel is smaller
/// than a voxel of the paper's, above the second the crown is one ball.
inline constexpr double kSmallestRadiusMax = 0.75, kLargestRadiusMax = 16;

/// A radius and the dilation that it gives.
struct RadiusFound {
  double radius = 0;     ///< R_max, crown units
  double dilation = 0;   ///< there
  bool reached = false;  ///< it is what was asked for; if not, it is the nearest that there is
};

/// R_max such that the dilation is `wanted`, within 0.004, or within 0.01 where the lattice allows
/// no closer; nothing where no radius that was tried gives a shape. `dilation_at`, nothing where
/// there is none, rises with the radius, but for the lattice's noise and for compact
/// trees, where it falls again beyond some radius; each call computes a shape. The search begins at
/// `start` and takes three or four calls, and no more than sixteen.
std::optional<RadiusFound> find_radius(
    double wanted, double start,
    const std::function<std::optional<double>(double radius)>& dilation_at);

}  // namespace leafhull
