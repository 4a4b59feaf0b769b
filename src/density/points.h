// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "density/descent.h"

namespace leafhull {

/// Points grouped by the brick that holds them: brick b holds index[first_point[b]] to
/// index[first_point[b + 1]], and bricks.kernels of b may reach them.
struct PointBatch {
  BrickList bricks;
  std::vector<std::uint32_t> first_point{0};
  std::vector<std::uint32_t> index;  ///< into the points asked about
  std::vector<Vec3f> offset;         ///< from the brick's origin, voxels
};

using PointVisitor = std::function<void(const PointBatch&)>;

/// Finds the kernels near each of `points` (voxels from the anchor), in batches of bounded size.
/// Points that no support reaches are left out: N is zero there.
void find_kernels_near(const KernelSet& kernels, std::span<const Vec3d> points, int falloff,
                       const PointVisitor& visit);

}  // namespace leafhull
