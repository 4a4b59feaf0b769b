// SPDX-License-Identifier: Apache-2.0
#include "surface/metrics.h"

#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>

namespace leafhull {
namespace {

enum class Side { outside, on, inside };

using Accessor = openvdb::FloatGrid::ConstAccessor;
using Corners = std::array<float, 8>;

/// The corner samples of a cell; bit 2 of the index is x, bit 1 y, bit 0 z.
Corners corners_of(const Accessor& depth, Coord cell) {
  Corners corners;
  for (int i = 0; i < 8; ++i) {
    corners[i] = depth.getValue(
        openvdb::Coord(cell.x + (i >> 2 & 1), cell.y + (i >> 1 & 1), cell.z + (i & 1)));
  }
  return corners;
}

Side side_of(const Corners& corners) {
  const auto inside = std::count_if(corners.begin(), corners.end(), [](float d) { return d < 0; });
  return inside == 0 ? Side::outside : inside == 8 ? Side::inside : Side::on;
}

struct VoxelCount {
  std::uint64_t inside = 0, on = 0;
  void add(Side side) {
    inside += side == Side::inside;
    on += side == Side::on;
  }
};

VoxelCount count_brick(const Accessor& depth, Coord origin) {
  VoxelCount count;
  for (int x = 0; x < kBrickEdge; ++x) {
    for (int y = 0; y < kBrickEdge; ++y) {
      for (int z = 0; z < kBrickEdge; ++z) {
        count.add(side_of(corners_of(depth, origin + Coord{x, y, z})));
      }
    }
  }
  return count;
}

/// A cell with a corner in an evaluated brick has its lowest corner there or in a neighbour, which,
/// if it was not evaluated, is proven to be on one side together with the cell.
VoxelCount count_voxels(const Field& field, const openvdb::FloatGrid& depth) {
  VoxelCount count = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, field.origins.size()), VoxelCount{},
      [&](const tbb::blocked_range<std::size_t>& bricks, VoxelCount sum) {
        const Accessor accessor = depth.getConstAccessor();
        for (std::size_t b = bricks.begin(); b < bricks.end(); ++b) {
          const VoxelCount one = count_brick(accessor, field.origins[b]);
          sum = {sum.inside + one.inside, sum.on + one.on};
        }
        return sum;
      },
      [](VoxelCount a, VoxelCount b) {
        return VoxelCount{a.inside + b.inside, a.on + b.on};
      });
  for (const Block& block : field.inside) {
    const auto edge = static_cast<std::uint64_t>(block.edge);
    count.inside += edge * edge * edge;
  }
  return count;
}

/// T - N at a point of a cell, trilinear.
double interpolate(const Corners& corners, Vec3d at) {
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    const double wx = i >> 2 & 1 ? at.x : 1 - at.x;
    const double wy = i >> 1 & 1 ? at.y : 1 - at.y;
    const double wz = i & 1 ? at.z : 1 - at.z;
    sum += wx * wy * wz * static_cast<double>(corners[i]);
  }
  return sum;
}

}  // namespace

Metrics measure(const Field& field, const openvdb::FloatGrid& depth,
                std::span<const Vec3d> leaf_vertices) {
  const VoxelCount voxels = count_voxels(field, depth);
  Metrics metrics;
  metrics.inside_voxels = voxels.inside;
  metrics.on_voxels = voxels.on;

  const Accessor accessor = depth.getConstAccessor();
  std::vector<Coord> occupied;  // cells of the shape that hold a leaf vertex
  for (const Vec3d p : leaf_vertices) {
    const Coord cell = cell_of(p);
    const Corners corners = corners_of(accessor, cell);
    const Side side = side_of(corners);
    if (side != Side::outside) occupied.push_back(cell);
    metrics.off_site_sampled +=
        side == Side::outside || (side == Side::on && interpolate(corners, p - to_vec3d(cell)) > 0);
  }
  tbb::parallel_sort(occupied);
  const auto end = std::unique(occupied.begin(), occupied.end());
  metrics.dilated_voxels = metrics.inside_voxels + metrics.on_voxels -
                           static_cast<std::uint64_t>(end - occupied.begin());
  return metrics;
}

}  // namespace leafhull
