// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>

#include "leafhull/vec.h"

namespace leafhull {

/// Lattice coordinates, relative to Lattice::anchor.
struct Coord {
  std::int32_t x = 0, y = 0, z = 0;
  friend auto operator<=>(const Coord&, const Coord&) = default;
  friend Coord operator+(Coord a, Coord b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
};

/// Samples per side of a brick, the unit of evaluation and a leaf node of the sparse grid.
inline constexpr int kBrickEdge = 8;
inline constexpr int kBrickSamples = kBrickEdge * kBrickEdge * kBrickEdge;
/// Samples per side of a root block, where the search for the surface starts.
inline constexpr int kRootEdge = 32;

/// A cube of samples (and of the cells above them): [origin, origin + edge) along each axis.
struct Block {
  Coord origin;
  int edge = kBrickEdge;
};

/// Samples, or the cells above them: [low, high) along each axis.
struct SampleBox {
  Coord low, high;
  bool meets(const Block& block) const {
    const Coord o = block.origin;
    return o.x < high.x && o.y < high.y && o.z < high.z && o.x + block.edge > low.x &&
           o.y + block.edge > low.y && o.z + block.edge > low.z;
  }
};

/// A block that is proven to lie inside N = threshold.
struct InsideBlock {
  Block block;
  double threshold;
};

/// The global lattice of integer multiples of the voxel size. Stages compute relative to an anchor,
/// a lattice point near the tree, so that a tree far from the origin loses no digits. SPEC: 5.
struct Lattice {
  double voxel_size = 1;        ///< h, model units, > 0
  Vec3<std::int64_t> anchor{};  ///< a multiple of kRootEdge along each axis

  /// The lattice of voxel size `voxel_size` anchored near `p`.
  static Lattice near(Vec3d p, double voxel_size) {
    const auto align = [&](double v) {
      return static_cast<std::int64_t>(std::floor(v / voxel_size / kRootEdge)) * kRootEdge;
    };
    return {voxel_size, {align(p.x), align(p.y), align(p.z)}};
  }

  /// A point in voxels from the anchor.
  Vec3d local(Vec3d p) const {
    return {p.x / voxel_size - static_cast<double>(anchor.x),
            p.y / voxel_size - static_cast<double>(anchor.y),
            p.z / voxel_size - static_cast<double>(anchor.z)};
  }

  /// The world position of a point given in voxels from the anchor.
  Vec3d world(Vec3d local) const {
    return {(static_cast<double>(anchor.x) + local.x) * voxel_size,
            (static_cast<double>(anchor.y) + local.y) * voxel_size,
            (static_cast<double>(anchor.z) + local.z) * voxel_size};
  }
};

/// The cell that holds a local point.
inline Coord cell_of(Vec3d local) {
  return {static_cast<std::int32_t>(std::floor(local.x)),
          static_cast<std::int32_t>(std::floor(local.y)),
          static_cast<std::int32_t>(std::floor(local.z))};
}

/// A corner of a cell: bit 2 of `i` is x, bit 1 y, bit 0 z.
inline Coord corner(Coord cell, int i) { return cell + Coord{i >> 2 & 1, i >> 1 & 1, i & 1}; }

/// The trilinear value at a point of a cell, 0..1 along each axis; `value(i)` is corner i's.
template <class Value>
double trilinear(Vec3d at, const Value& value) {
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    const double x = i >> 2 & 1 ? at.x : 1 - at.x, y = i >> 1 & 1 ? at.y : 1 - at.y;
    sum += x * y * (i & 1 ? at.z : 1 - at.z) * static_cast<double>(value(i));
  }
  return sum;
}

/// The origin of the block of edge `edge` (a power of two) that holds a cell.
inline Coord block_origin(Coord cell, int edge) {
  return {cell.x & -edge, cell.y & -edge, cell.z & -edge};
}

inline Vec3d to_vec3d(Coord c) {
  return {static_cast<double>(c.x), static_cast<double>(c.y), static_cast<double>(c.z)};
}

}  // namespace leafhull
