// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "density/kernel_set.h"

namespace leafhull {

/// Positions are counted from the origin of a point's frame, a block of this many voxels, so that N
/// there depends on the point alone.
inline constexpr int kFrameEdge = 16;

/// Points that are evaluated together, as the device reads it (`Chunk` of points.cl).
struct PointChunk {
  Coord origin;                  ///< of the frame that holds them
  std::uint32_t first = 0, end;  ///< into PointBatch::kernels: those that may reach the points
};
static_assert(sizeof(PointChunk) == 20);

/// Points in chunks; a chunk that is not full repeats a point.
struct PointBatch {
  std::size_t chunk_points = 0;  ///< points per chunk
  std::vector<PointChunk> chunks;
  std::vector<std::uint32_t> kernels;  ///< ascending in each chunk
  std::vector<std::uint32_t> index;    ///< into the points to evaluate
  std::vector<float> x, y, z;          ///< offsets from the frame's origin, voxels
};

/// The places at which a point may be evaluated: its position alone, or anywhere in its cell.
enum class Within { point, cell };

/// Finds the kernels near each of `points` (voxels from the anchor) and hands them over, in batches
/// of bounded size. The device works only while no search runs.
/// @param chunk_points at least 8.
void find_kernels_near(const KernelSet& kernels, std::span<const Vec3d> points, Within within,
                       std::size_t chunk_points, const std::function<void(PointBatch&)>& visit);
void find_kernels_near(const KernelSet& kernels, std::span<const Vec3f> points, Within within,
                       std::size_t chunk_points, const std::function<void(PointBatch&)>& visit);

}  // namespace leafhull
