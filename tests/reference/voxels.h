// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "density.h"

namespace recount {

/// Values this close to T, relatively, may round to either side in float32.
inline constexpr double kRounding = 1e-5;

/// A count in float64, and the least and the most it can be after float32 rounding.
struct Count {
  std::uint64_t low = 0, exact = 0, high = 0;
};

struct VoxelCounts {
  Count inside, on, dilated;
  std::uint64_t samples_beside_surface = 0;  ///< corners of `on` voxels that rounding cannot change
};

/// The lattice's cells by their corners, N >= threshold being inside; `vertices` are the leaf
/// vertices. SPEC: 6.
VoxelCounts count_voxels(const Lattice& lattice, const std::vector<Point>& vertices,
                         double threshold);

Count count_below(const std::vector<double>& values, double threshold);

}  // namespace recount
