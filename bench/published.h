// SPDX-License-Identifier: Apache-2.0
// The algorithm as the paper published it: a dense grid, one thread, doubles, marching cubes. It
// shares nothing with leafhull but the vector type. Source: Figure 8 and section 3.3, p. 53.
#pragma once

#include <span>
#include <vector>

#include "bench/marching_cubes.h"
#include "leafhull/vec.h"

namespace leafhull::bench::published {

/// A leaf vertex c_j with its frame; the third axis is normal x major.
struct Leaf {
  Vec3d position, normal, major;
  double radius_major, radius_minor;  ///< R_u, R_v
};

struct Parameters {
  double radius_max = 0;   ///< R_max
  double voxel = 0;        ///< h
  double flatness = 1;     ///< lambda_R
  bool controlled = true;  ///< false: the method of Luft and Deussen, R_max everywhere
  /// Whether a cell vertex sums over all leaf vertices, as Eq. (2) says it, rather than a density
  /// function adding itself to the cell vertices within its influencing bound, as step 6 does.
  bool literal = false;
};

/// Step 1: cells over the bounding box of the leaf vertices, grown so that no support leaves it.
/// @throws std::runtime_error where the grid would have more than 2^31 cell vertices.
Grid set_grid(std::span<const Leaf> leaves, const Parameters& parameters);

/// Steps 1 to 6: N at the cell vertices.
Grid density_field(std::span<const Leaf> leaves, const Parameters& parameters);

/// N at a point inside the grid by trilinear interpolation.
double interpolated(const Grid& grid, Vec3d p);

/// T such that the fraction `coverage` of the leaf vertices has an interpolated N of at least T.
double threshold_for_coverage(const Grid& grid, std::span<const Leaf> leaves, double coverage);

}  // namespace leafhull::bench::published
