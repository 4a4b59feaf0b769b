// SPDX-License-Identifier: Apache-2.0
#include "surface/metrics.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "density/field_grid.h"
#include "density/simd.h"

namespace leafhull {
namespace {

using Accessor = openvdb::FloatGrid::ConstAccessor;

/// Whether N >= T at the samples of a brick and at the first ones beyond it in x: a word per x, bit
/// 8 y + z.
using Layers = std::array<std::uint64_t, kBrickEdge + 1>;

std::uint64_t inside_layer(const float* negated, float iso) {
  std::uint64_t layer = 0;
  for (int y = 0; y < kBrickEdge; ++y) {
    Floats row;
    std::memcpy(&row, negated + kBrickEdge * y, sizeof row);
    layer |= std::uint64_t{bits_of(row < iso)} << (kBrickEdge * y);
  }
  return layer;
}

Layers inside_layers(const Accessor& negated, float iso, const openvdb::Coord& origin) {
  Layers layers;
  const auto fill = [&](const openvdb::Coord& at, std::span<std::uint64_t> words) {
    if (const Brick* brick = negated.probeConstLeaf(at)) {
      const float* values = brick->buffer().data();
      for (std::size_t x = 0; x < words.size(); ++x) words[x] = inside_layer(values + 64 * x, iso);
    } else {
      std::ranges::fill(words, negated.getValue(at) < iso ? ~std::uint64_t{0} : 0);
    }
  };
  fill(origin, std::span(layers).first(kBrickEdge));
  fill(origin.offsetBy(kBrickEdge, 0, 0), std::span(layers).last(1));
  return layers;
}

/// The squares between the samples of a layer and their neighbours in y and z, at the bits of their
/// lowest corners.
struct Squares {
  std::uint64_t all, some;  ///< corners inside
};

/// `y` etc.: the layer of the next brick in that direction.
Squares squares(std::uint64_t here, std::uint64_t y, std::uint64_t z, std::uint64_t yz) {
  const auto next_y = [](std::uint64_t low, std::uint64_t high) { return low >> 8 | high << 56; };
  const auto next_z = [](std::uint64_t low, std::uint64_t high) {
    return (low >> 1 & 0x7f7f7f7f7f7f7f7f) | (high << 7 & 0x8080808080808080);
  };
  const std::uint64_t at_y = next_y(here, y), at_z = next_z(here, z);
  const std::uint64_t at_yz = next_y(at_z, next_z(y, yz));
  return {here & at_y & at_z & at_yz, here | at_y | at_z | at_yz};
}

struct VoxelCount {
  std::uint64_t inside = 0, on = 0;
  friend VoxelCount operator+(VoxelCount a, VoxelCount b) {
    return {a.inside + b.inside, a.on + b.on};
  }
};

VoxelCount count_brick(const Accessor& negated, float iso, const openvdb::Coord& origin) {
  const auto layers = [&](int y, int z) {
    return inside_layers(negated, iso, origin.offsetBy(0, y, z));
  };
  const Layers here = layers(0, 0), y = layers(8, 0), z = layers(0, 8), yz = layers(8, 8);
  VoxelCount count;
  Squares low = squares(here[0], y[0], z[0], yz[0]);
  for (std::size_t x = 1; x <= kBrickEdge; ++x) {
    const Squares high = squares(here[x], y[x], z[x], yz[x]);
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
  VoxelCount count = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, bricks_of(field).size()), VoxelCount{},
      [&](const tbb::blocked_range<std::size_t>& bricks, VoxelCount sum) {
        const Accessor negated = negated_grid(field).getConstAccessor();
        for (std::size_t b = bricks.begin(); b < bricks.end(); ++b) {
          sum = sum + count_brick(negated, field.iso_value(), bricks_of(field)[b]->origin());
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

Corners corners_of(const Accessor& negated, Coord cell) {
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
  std::vector<Coord> cells;    ///< cells of the shape that hold a vertex, some more than once
  std::uint64_t off_site = 0;  ///< vertices outside the shape

  void append(const Placed& other) {
    cells.insert(cells.end(), other.cells.begin(), other.cells.end());
    off_site += other.off_site;
  }
};

void place(std::span<const Vec3d> leaf_vertices, const Field& field, Placed& placed) {
  const Accessor negated = negated_grid(field).getConstAccessor();
  const float iso = field.iso_value();
  for (const Vec3d p : leaf_vertices) {
    const Coord cell = cell_of(p);
    const Corners corners = corners_of(negated, cell);
    const auto inside =
        std::count_if(corners.begin(), corners.end(), [&](float n) { return n < iso; });
    if (inside > 0 && (placed.cells.empty() || placed.cells.back() != cell)) {
      placed.cells.push_back(cell);
    }
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
  for (const Placed& part : parts) all.append(part);
  return all;
}

std::uint64_t count_different(std::vector<Coord> cells) {
  tbb::parallel_sort(cells);
  return static_cast<std::uint64_t>(std::unique(cells.begin(), cells.end()) - cells.begin());
}

/// Whether a place belongs to the shape.
bool is_in_shape(Vec3d place, const Field& field, const Accessor& negated,
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
        const Accessor negated = negated_grid(field).getConstAccessor();
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
  Placed placed = place(places, field);
  const std::uint64_t off_site = placed.off_site;
  placed.append(place(others, field));
  Metrics metrics;
  metrics.inside_voxels = voxels.inside;
  metrics.on_voxels = voxels.on;
  metrics.dilated_voxels = voxels.inside + voxels.on - count_different(std::move(placed.cells));
  metrics.off_site_sampled = off_site;
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
