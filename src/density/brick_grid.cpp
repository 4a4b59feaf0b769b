// SPDX-License-Identifier: Apache-2.0
#include "density/brick_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <limits>

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

int child_index(Coord cell) {
  const auto along = [](std::int32_t v) { return v / kBrickEdge & (kBricksAlong - 1); };
  const Coord b = block_origin(cell, kBrickEdge);
  return (along(b.x) * kBricksAlong + along(b.y)) * kBricksAlong + along(b.z);
}

int cell_index(Coord cell) {
  return ((cell.x & 7) * kBrickEdge + (cell.y & 7)) * kBrickEdge + (cell.z & 7);
}

Coord origin_of(const Field::Brick& brick) {
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
  for (const Field::Brick* brick : field.bricks()) include(origin_of(*brick));
  for (const Block& block : inside) include(block.origin);
  if (most.x < least.x) least = most = {};

  low = least;
  size = {most.x - least.x + 1, most.y - least.y + 1, most.z - least.z + 1};
  const std::int64_t count = std::int64_t{size.x} * size.y * size.z;
  if (count > kMostRoots) {
    throw Error(ErrorCode::usage, "the crown is too wide for this resolution to be drawn directly",
                "Lower --resolution, or take --surface mesh.");
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
  const std::span<const Field::Brick* const> bricks = field.bricks();
  samples.resize(bricks.size() * kBrickSamples);
  hidden.assign(bricks.size() * kBrickMaskWords, 0);
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    child(origin_of(*bricks[b])) = static_cast<std::int32_t>(b);
  }
  tbb::parallel_for(std::size_t{0}, bricks.size(), [&](std::size_t b) {
    const float* const values = bricks[b]->buffer().data();
    std::transform(values, values + kBrickSamples, samples.data() + b * kBrickSamples,
                   std::negate<>());
  });
}

std::int32_t& BrickGrid::child(Coord cell) {
  const Coord root = root_of(cell);
  std::int32_t& first = roots[static_cast<std::size_t>(
      (std::int64_t{root.x - low.x} * size.y + (root.y - low.y)) * size.z + (root.z - low.z))];
  if (first < 0) {
    first = static_cast<std::int32_t>(children.size());
    children.insert(children.end(), kChildren, kOutside);
  }
  return children[static_cast<std::size_t>(first + child_index(cell))];
}

std::int32_t BrickGrid::content(Coord cell) const {
  const Coord root = root_of(cell);
  const Coord at{root.x - low.x, root.y - low.y, root.z - low.z};
  const bool within =
      at.x >= 0 && at.x < size.x && at.y >= 0 && at.y < size.y && at.z >= 0 && at.z < size.z;
  if (!within) return kOutside;
  const std::int32_t first =
      roots[static_cast<std::size_t>((std::int64_t{at.x} * size.y + at.y) * size.z + at.z)];
  return first < 0 ? first : children[static_cast<std::size_t>(first + child_index(cell))];
}

void BrickGrid::draw_only(std::span<const Coord> cells, std::span<const Coord> others) {
  std::fill(hidden.begin(), hidden.end(), ~0u);
  const auto word = [&](Coord cell) -> std::uint32_t* {
    const std::int32_t brick = content(cell);
    return brick < 0 ? nullptr
                     : &hidden[static_cast<std::size_t>(brick) * kBrickMaskWords +
                               static_cast<std::size_t>(cell_index(cell) / 32)];
  };
  const auto bit = [](Coord cell) { return 1u << (cell_index(cell) % 32); };
  for (const Coord cell : cells) {
    for (int n = 0; n < 27; ++n) {
      const Coord near = cell + Coord{n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1};
      if (std::uint32_t* w = word(near)) *w &= ~bit(near);
    }
  }
  for (const Coord cell : others) {
    if (std::uint32_t* w = word(cell)) *w |= bit(cell);
  }
  for (const Coord cell : cells) {
    if (std::uint32_t* w = word(cell)) *w &= ~bit(cell);
  }
}

}  // namespace leafhull
