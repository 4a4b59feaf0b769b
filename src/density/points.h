// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "density/descent.h"

namespace leafhull {

/// Positions are counted from the origin of a point's frame, a block of this many voxels, so that N
/// there depends on the point alone.
inline constexpr int kFrameEdge = 16;

/// Points of a block, a brick or a whole frame with few points, that are evaluated together, in up
/// to kGroupChunks chunks, as the device reads it (`Group` of points.cl).
struct PointGroup {
  Coord origin;                        ///< of the frame that holds them
  std::uint32_t first = 0, end = 0;    ///< into PointBatch::bricks.kernels: the list of their block
  std::uint32_t chunk = 0, count = 0;  ///< its first chunk, and their number
  std::uint32_t entry = 0;             ///< its place in the scratch space of a launch
};
static_assert(sizeof(PointGroup) == 32);

inline constexpr std::size_t kGroupChunks = 8;

/// The boxes in which the points of each chunk of a group may be evaluated, from the group's
/// origin: centre and half the extent along x, y and z, voxels. Chunks that a group lacks repeat
/// the last.
using ChunkBoxes = std::array<std::array<float, kGroupChunks>, 6>;

/// Points in chunks; a chunk that is not full repeats a point.
struct PointBatch {
  std::size_t chunk_points = 0;  ///< points per chunk
  BrickList bricks;              ///< the blocks that hold the points
  std::vector<PointGroup> groups;
  std::vector<ChunkBoxes> boxes;     ///< by group
  std::vector<std::uint32_t> index;  ///< into the points to evaluate
  std::vector<float> x, y, z;        ///< offsets from the frame's origin, voxels

  /// Adds blocks with their groups.
  void append(const PointBatch& other);
};

/// The places at which a point may be evaluated: its position alone, or anywhere in its cell.
enum class Within { point, cell };

/// How points are searched for.
struct PointSearch {
  Within within = Within::point;
  std::size_t chunk_points = 8;  ///< points per chunk
  /// Lists for the bricks of some of the points, grown by a voxel or more; null: none.
  const BrickList* known = nullptr;
};

/// Finds the kernels near each of `points` (voxels from the anchor), block by block, and hands them
/// over in batches of bounded size. The device works only while no search runs.
void find_kernels_near(const KernelSet& kernels, std::span<const Vec3d> points,
                       const PointSearch& how, const std::function<void(PointBatch&)>& visit);
void find_kernels_near(const KernelSet& kernels, std::span<const Vec3f> points,
                       const PointSearch& how, const std::function<void(PointBatch&)>& visit);

}  // namespace leafhull
