// SPDX-License-Identifier: Apache-2.0
#include "density/brick_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "density/field_grid.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

constexpr std::int64_t kMostRoots = std::int64_t{1} << 26;
constexpr int kBricksAlong = kRootEdge / kBrickEdge;

Coord root_of(Coord cell) {
  // Exact for negative cells too: a root's origin is a multiple of its edge.
  const Coord origin = block_origin(cell, kRootEdge);
  return {origin.x / kRootEdge, origin.y / kRootEdge, origin.z / kRootEdge};
}

std::size_t child_index(Coord cell) {
  const auto along = [](std::int32_t v) {
    return static_cast<std::size_t>(v / kBrickEdge & (kBricksAlong - 1));
  };
  const Coord b = block_origin(cell, kBrickEdge);
  return (along(b.x) * kBricksAlong + along(b.y)) * kBricksAlong + along(b.z);
}

/// The bit of a cell within its slab of the brick's bits.
std::uint64_t bit_of(Coord cell) {
  return std::uint64_t{1} << ((cell.y & 7) * kBrickEdge + (cell.z & 7));
}

using Slab = std::uint64_t;  // the cells of a brick at one x
constexpr Slab kFirstZ = 0x0101010101010101, kLastZ = kFirstZ << 7;

// The cells of a slab shifted by one; those of the neighbouring brick come in.
Slab up_z(Slab here, Slab below) { return (here & ~kLastZ) << 1 | (below & kLastZ) >> 7; }
Slab down_z(Slab here, Slab above) { return (here & ~kFirstZ) >> 1 | (above & kFirstZ) << 7; }
Slab up_y(Slab here, Slab below) { return here << 8 | below >> 56; }
Slab down_y(Slab here, Slab above) { return here >> 8 | above << 56; }

Coord origin_of(const Brick& brick) {
  const openvdb::Coord o = brick.origin();
  return {o.x(), o.y(), o.z()};
}

}  // namespace

BrickGrid::BrickGrid(const Field& field) {
  constexpr std::int32_t kLargest = std::numeric_limits<std::int32_t>::max();
  const std::vector<Block> inside = field.inside();
  Coord least{kLargest, kLargest, kLargest}, most{-kLargest, -kLargest, -kLargest};
  const auto include = [&](Coord origin) {
    const Coord root = root_of(origin);
    least = {std::min(least.x, root.x), std::min(least.y, root.y), std::min(least.z, root.z)};
    most = {std::max(most.x, root.x), std::max(most.y, root.y), std::max(most.z, root.z)};
  };
  for (const Brick* brick : bricks_of(field)) include(origin_of(*brick));
  for (const Block& block : inside) include(block.origin);
  if (most.x < least.x) least = most = {};

  low = least;
  size = {most.x - least.x + 1, most.y - least.y + 1, most.z - least.z + 1};
  const std::int64_t count = std::int64_t{size.x} * size.y * size.z;
  if (count > kMostRoots) {
    throw Error(ErrorCode::usage, "the crown is too wide for this resolution to be drawn directly",
                "Lower --resolution, or use --surface mesh.");
  }
  roots.assign(static_cast<std::size_t>(count), kOutside);
  for (const Block& block : inside) {
    for (int x = 0; x < block.edge; x += kBrickEdge) {
      for (int y = 0; y < block.edge; y += kBrickEdge) {
        for (int z = 0; z < block.edge; z += kBrickEdge) {
          child(block.origin + Coord{x, y, z}) = kInside;
        }
      }
    }
  }
  const std::span<const Brick* const> bricks = bricks_of(field);
  samples.resize(bricks.size() * kBrickSamples);
  origins_.reserve(bricks.size());
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    origins_.push_back(origin_of(*bricks[b]));
    child(origins_.back()) = static_cast<std::int32_t>(b);
  }
  tbb::parallel_for(std::size_t{0}, bricks.size(), [&](std::size_t b) {
    const float* const values = bricks[b]->buffer().data();
    std::transform(values, values + kBrickSamples, samples.data() + b * kBrickSamples,
                   std::negate<>());
  });
  drawn = with_neighbours(crossed(inside_value(field.threshold())));
  near = with_neighbours(drawn);
}

std::int32_t& BrickGrid::child(Coord cell) {
  const Coord root = root_of(cell);
  std::int32_t& first = roots[static_cast<std::size_t>(
      (std::int64_t{root.x - low.x} * size.y + (root.y - low.y)) * size.z + (root.z - low.z))];
  if (first < 0) {
    first = static_cast<std::int32_t>(children.size());
    children.insert(children.end(), kChildren, kOutside);
  }
  return children[static_cast<std::size_t>(first) + child_index(cell)];
}

std::int32_t BrickGrid::content(Coord cell) const {
  const Coord root = root_of(cell);
  const Coord at{root.x - low.x, root.y - low.y, root.z - low.z};
  const bool within =
      at.x >= 0 && at.x < size.x && at.y >= 0 && at.y < size.y && at.z >= 0 && at.z < size.z;
  if (!within) return kOutside;
  const std::int32_t first =
      roots[static_cast<std::size_t>((std::int64_t{at.x} * size.y + at.y) * size.z + at.z)];
  return first < 0 ? first : children[static_cast<std::size_t>(first) + child_index(cell)];
}

/// Cells with corners on both sides.
std::vector<CellBits> BrickGrid::crossed(float threshold) const {
  const std::size_t count = origins_.size();
  std::vector<CellBits> inside(count), cells(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t b) {
    for (int s = 0; s < kBrickSamples; ++s) {
      const Slab reached = samples[b * kBrickSamples + static_cast<std::size_t>(s)] >= threshold;
      inside[b][static_cast<std::size_t>(s / 64)] |= reached << s % 64;
    }
  });
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t b) {
    const auto slab = [&](int x, int by, int bz) -> Slab {
      const Coord at = origins_[b] + Coord{x & 8, by * kBrickEdge, bz * kBrickEdge};
      const std::int32_t brick = content(at);
      return brick >= 0 ? inside[static_cast<std::size_t>(brick)][static_cast<std::size_t>(x & 7)]
             : brick == kInside ? ~Slab{0}
                                : 0;
    };
    /// For all cells at one x, whether any corner is inside and whether all are.
    const auto corners = [&](int x) {
      const auto along_z = [&](int by) {
        const Slab here = slab(x, by, 0), next = down_z(here, slab(x, by, 1));
        return std::pair(here | next, here & next);
      };
      const auto [any, all] = along_z(0);
      const auto [any_above, all_above] = along_z(1);
      return std::pair(any | down_y(any, any_above), all & down_y(all, all_above));
    };
    auto [any, all] = corners(0);
    for (int x = 0; x < kBrickEdge; ++x) {
      const auto [any_next, all_next] = corners(x + 1);
      cells[b][static_cast<std::size_t>(x)] = (any | any_next) & ~(all & all_next);
      any = any_next, all = all_next;
    }
  });
  return cells;
}

/// The cells and the 26 around each.
std::vector<CellBits> BrickGrid::with_neighbours(const std::vector<CellBits>& cells) const {
  const auto widened = [&](const std::vector<CellBits>& from, Coord axis, auto&& widen) {
    std::vector<CellBits> wide(from.size());
    const CellBits none{};
    tbb::parallel_for(std::size_t{0}, from.size(), [&](std::size_t b) {
      const auto beside = [&](int side) -> const CellBits& {
        const Coord o = origins_[b];
        const std::int32_t brick = content(o + Coord{axis.x * side, axis.y * side, axis.z * side});
        return brick < 0 ? none : from[static_cast<std::size_t>(brick)];
      };
      wide[b] = widen(beside(-kBrickEdge), from[b], beside(kBrickEdge));
    });
    return wide;
  };
  const auto slabs = [](auto&& widen) {
    return [widen](const CellBits& below, const CellBits& here, const CellBits& above) {
      CellBits wide;
      for (std::size_t x = 0; x < kBrickEdge; ++x) wide[x] = widen(below[x], here[x], above[x]);
      return wide;
    };
  };
  const auto along_x = [](const CellBits& below, const CellBits& here, const CellBits& above) {
    CellBits wide;
    for (std::size_t x = 0; x < kBrickEdge; ++x) {
      wide[x] = here[x] | (x > 0 ? here[x - 1] : below[kBrickEdge - 1]) |
                (x + 1 < kBrickEdge ? here[x + 1] : above[0]);
    }
    return wide;
  };
  const auto in_z = widened(cells, {0, 0, 1}, slabs([](Slab below, Slab here, Slab above) {
                              return here | up_z(here, below) | down_z(here, above);
                            }));
  const auto in_y = widened(in_z, {0, 1, 0}, slabs([](Slab below, Slab here, Slab above) {
                              return here | up_y(here, below) | down_y(here, above);
                            }));
  return widened(in_y, {1, 0, 0}, along_x);
}

void BrickGrid::draw_only(std::span<const Coord> kept, std::span<const Coord> dropped) {
  const auto bits_of = [&](std::span<const Coord> cells) {
    std::vector<CellBits> bits(origins_.size());
    for (const Coord cell : cells) {
      const std::int32_t brick = content(cell);
      if (brick < 0) continue;
      bits[static_cast<std::size_t>(brick)][static_cast<std::size_t>(cell.x & 7)] |= bit_of(cell);
    }
    return bits;
  };
  const std::vector<CellBits> cells = bits_of(kept), others = bits_of(dropped);
  drawn = with_neighbours(cells);
  near = with_neighbours(drawn);
  for (std::size_t b = 0; b < drawn.size(); ++b) {
    for (std::size_t x = 0; x < kBrickEdge; ++x) drawn[b][x] &= ~(others[b][x] & ~cells[b][x]);
  }
}

}  // namespace leafhull
