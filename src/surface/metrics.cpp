// SPDX-License-Identifier: Apache-2.0
#include "surface/metrics.h"

#include <openvdb/openvdb.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <bit>
#include <memory>

#include "density/field_grid.h"

namespace leafhull {
namespace {

namespace util = openvdb::util;
using openvdb::MaskTree;
using MaskAccessor = openvdb::tree::ValueAccessor<const MaskTree>;

/// The samples of a brick with N >= T.
util::NodeMask<3> inside_samples(const Brick& negated, float iso) {
  util::NodeMask<3> inside;
  const float* values = negated.buffer().data();
  for (openvdb::Index x = 0; x < kBrickEdge; ++x) {
    std::uint64_t layer = 0;
    for (int yz = 0; yz < 64; ++yz) layer |= std::uint64_t{*values++ < iso} << yz;
    inside.getWord<std::uint64_t>(x) = layer;
  }
  return inside;
}

/// The samples with N >= T.
MaskTree inside_samples(const Field& field) {
  const openvdb::FloatTree& negated = negated_grid(field).tree();
  MaskTree inside(negated, false, openvdb::TopologyCopy());
  std::vector<MaskTree::LeafNodeType*> leaves;
  inside.getNodes(leaves);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&, iso = field.iso_value()](std::size_t i) {
    const Brick* brick = negated.probeConstLeaf(leaves[i]->origin());
    leaves[i]->setValueMask(inside_samples(*brick, iso));
  });
  for (const Block& block : field.inside()) inside.fill(samples_of(block), true);
  return inside;
}

/// A brick's 64 samples at one x; bit 8 y + z.
std::uint64_t layer(const MaskAccessor& inside, const openvdb::Coord& at) {
  if (const MaskTree::LeafNodeType* leaf = inside.probeConstLeaf(at)) {
    return leaf->valueMask().getWord<std::uint64_t>(
        static_cast<openvdb::Index>(at.x() & (kBrickEdge - 1)));
  }
  return inside.isValueOn(at) ? ~std::uint64_t{0} : 0;
}

/// The squares between the samples of a layer and their neighbours in y and z, at the bits of their
/// lowest corners.
struct Squares {
  std::uint64_t all, some;  ///< corners inside
};

Squares squares(const MaskAccessor& inside, const openvdb::Coord& at) {
  const auto next_y = [](std::uint64_t here, std::uint64_t above) {
    return here >> 8 | above << 56;
  };
  const auto next_z = [](std::uint64_t here, std::uint64_t above) {
    return (here >> 1 & 0x7f7f7f7f7f7f7f7f) | (above << 7 & 0x8080808080808080);
  };
  const std::uint64_t low = layer(inside, at), y_low = layer(inside, at.offsetBy(0, 8, 0));
  const std::uint64_t z = next_z(low, layer(inside, at.offsetBy(0, 0, 8)));
  const std::uint64_t y_z = next_z(y_low, layer(inside, at.offsetBy(0, 8, 8)));
  const std::uint64_t y = next_y(low, y_low), yz = next_y(z, y_z);
  return {low & z & y & yz, low | z | y | yz};
}

struct VoxelCount {
  std::uint64_t inside = 0, on = 0;
  friend VoxelCount operator+(VoxelCount a, VoxelCount b) {
    return {a.inside + b.inside, a.on + b.on};
  }
};

VoxelCount count_brick(const MaskAccessor& inside, const openvdb::Coord& origin) {
  VoxelCount count;
  Squares low = squares(inside, origin);
  for (int x = 1; x <= kBrickEdge; ++x) {
    const Squares high = squares(inside, origin.offsetBy(x, 0, 0));
    const std::uint64_t all = low.all & high.all, some = low.some | high.some;
    count = count + VoxelCount{static_cast<std::uint64_t>(std::popcount(all)),
                               static_cast<std::uint64_t>(std::popcount(some & ~all))};
    low = high;
  }
  return count;
}

/// A cell with a corner in an evaluated brick has its lowest corner there or in a neighbour. If the
/// neighbour was not evaluated, it and the cell are proven to lie on one side.
VoxelCount count_voxels(const Field& field) {
  const MaskTree inside = inside_samples(field);
  VoxelCount count = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, bricks_of(field).size()), VoxelCount{},
      [&](const tbb::blocked_range<std::size_t>& bricks, VoxelCount sum) {
        const MaskAccessor accessor(inside);
        for (std::size_t b = bricks.begin(); b < bricks.end(); ++b) {
          sum = sum + count_brick(accessor, bricks_of(field)[b]->origin());
        }
        return sum;
      },
      std::plus<>());
  for (const Block& block : field.inside()) {
    const auto edge = static_cast<std::uint64_t>(block.edge);
    count.inside += edge * edge * edge;
  }
  return count;
}

/// -N at the corners of a cell.
using Corners = std::array<float, 8>;

Corners corners_of(const openvdb::FloatGrid::ConstAccessor& negated, Coord cell) {
  Corners corners;
  for (int i = 0; i < 8; ++i) {
    const Coord at = corner(cell, i);
    corners[static_cast<std::size_t>(i)] = negated.getValue(openvdb::Coord(at.x, at.y, at.z));
  }
  return corners;
}

std::ptrdiff_t count_inside(const Corners& corners, float iso) {
  return std::ranges::count_if(corners, [&](float n) { return n < iso; });
}

/// -N at a point of the cell, trilinear.
double interpolate(const Corners& corners, Vec3d at) {
  return trilinear(at, [&](int i) { return corners[static_cast<std::size_t>(i)]; });
}

/// Where the leaf vertices lie.
struct Placed {
  MaskTree::Ptr cells = std::make_shared<MaskTree>();  ///< cells of the shape that hold a vertex
  std::uint64_t off_site = 0;                          ///< vertices outside the shape
};

void place(std::span<const Vec3d> leaf_vertices, const Field& field, Placed& placed) {
  const openvdb::FloatGrid::ConstAccessor negated = negated_grid(field).getConstAccessor();
  openvdb::tree::ValueAccessor<MaskTree> cells(*placed.cells);
  const float iso = field.iso_value();
  for (const Vec3d p : leaf_vertices) {
    const Coord cell = cell_of(p);
    const Corners corners = corners_of(negated, cell);
    const auto inside = count_inside(corners, iso);
    if (inside > 0) cells.setValueOn(openvdb::Coord(cell.x, cell.y, cell.z));
    const bool on = 0 < inside && inside < 8;
    placed.off_site +=
        inside == 0 || (on && interpolate(corners, p - to_vec3d(cell)) > -field.threshold());
  }
}

Placed place(std::span<const Vec3d> leaf_vertices, const Field& field) {
  tbb::enumerable_thread_specific<Placed> parts;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaf_vertices.size(), 1024),
                    [&](const tbb::blocked_range<std::size_t>& r) {
                      place(leaf_vertices.subspan(r.begin(), r.size()), field, parts.local());
                    });
  Placed all;
  for (const Placed& part : parts) {
    all.cells->topologyUnion(*part.cells);
    all.off_site += part.off_site;
  }
  return all;
}

/// Whether a place belongs to the shape.
bool is_in_shape(Vec3d place, const Field& field, const openvdb::FloatGrid::ConstAccessor& negated,
                 std::span<const Coord> dropped) {
  const float iso = field.iso_value();
  Coord cell = cell_of(place);
  Corners corners = corners_of(negated, cell);
  if (count_inside(corners, iso) < 8 &&
      interpolate(corners, place - to_vec3d(cell)) > -field.threshold()) {
    return false;
  }
  if (dropped.empty()) return true;
  // The first surface along +x is the one that encloses the place.
  while (count_inside(corners, iso) == 8) {
    ++cell.x;
    corners = corners_of(negated, cell);
  }
  return !std::ranges::binary_search(dropped, cell);
}

}  // namespace

double share_outside(const Field& field, std::span<const Vec3d> places,
                     std::span<const Coord> dropped) {
  const auto outside = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, places.size(), 256), std::size_t{0},
      [&](const tbb::blocked_range<std::size_t>& r, std::size_t count) {
        const openvdb::FloatGrid::ConstAccessor negated = negated_grid(field).getConstAccessor();
        for (std::size_t i = r.begin(); i < r.end(); ++i) {
          count += !is_in_shape(places[i], field, negated, dropped);
        }
        return count;
      },
      std::plus<>());
  return static_cast<double>(outside) / static_cast<double>(places.size());
}

Metrics measure(const Field& field, std::span<const Vec3d> places, std::span<const Vec3d> others) {
  const VoxelCount voxels = count_voxels(field);
  const Placed placed = place(places, field);
  placed.cells->topologyUnion(*place(others, field).cells);
  Metrics metrics;
  metrics.inside_voxels = voxels.inside;
  metrics.on_voxels = voxels.on;
  metrics.dilated_voxels = voxels.inside + voxels.on - placed.cells->activeVoxelCount();
  metrics.off_site_sampled = placed.off_site;
  return metrics;
}

std::vector<Vec3d> extent_of(const Field& field) {
  const auto to_local = [](const openvdb::Coord& c) { return to_vec3d({c.x(), c.y(), c.z()}); };
  std::vector<Vec3d> points;
  for (const Brick* brick : bricks_of(field)) {
    Box box;
    const float* const negated = brick->buffer().data();
    for (openvdb::Index i = 0; i < Brick::SIZE; ++i) {
      if (negated[i] < field.iso_value()) box.include(to_local(brick->offsetToGlobalCoord(i)));
    }
    if (box.empty()) continue;
    for (const double x : {box.low.x, box.high.x}) {
      for (const double y : {box.low.y, box.high.y}) {
        for (const double z : {box.low.z, box.high.z}) {
          points.push_back(field.lattice().world({x, y, z}));
        }
      }
    }
  }
  return points;
}

}  // namespace leafhull
