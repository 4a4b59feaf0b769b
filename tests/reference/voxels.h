// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "density.h"

namespace recount {

/// Values within this relative distance of T may round to either side in float32.
inline constexpr double kRounding = 1e-5;

/// A count in float64, and its least and greatest values after rounding to float32.
struct Count {
  std::uint64_t low = 0, exact = 0, high = 0;
};

struct VoxelCounts {
  Count inside, on, dilated;
  std::uint64_t samples_beside_surface = 0;  ///< corners of `on` voxels that rounding cannot change
};

/// Counts the lattice's cells by their corners, which are inside if N >= threshold; `vertices` are
/// the leaf vertices. SPEC: 6.
VoxelCounts count_voxels(const Lattice& lattice, const std::vector<Point>& vertices,
                         double threshold);

Count count_below(const std::vector<double>& values, double threshold);

}  // namespace recount
