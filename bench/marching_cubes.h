// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "leafhull/vec.h"

namespace leafhull::bench::published {

/// Values at the corners of a dense grid of cubic cells.
struct Grid {
  std::array<std::int64_t, 3> low{};   ///< the first corner is at low * voxel
  std::array<std::size_t, 3> count{};  ///< corners along each axis
  double voxel = 1;
  std::vector<double> values;  ///< z fastest

  std::size_t index(std::size_t x, std::size_t y, std::size_t z) const {
    return (x * count[1] + y) * count[2] + z;
  }
};

struct TriangleMesh {
  std::vector<Vec3d> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// The surface where the values are `threshold`, larger ones being inside. Source: Lorensen and
/// Cline 1987; faces with two diagonal corners inside are cut between these corners on both sides,
/// so that the mesh has no holes.
TriangleMesh marching_cubes(const Grid& grid, double threshold);

}  // namespace leafhull::bench::published
