// SPDX-License-Identifier: Apache-2.0
#include "surface/hollows.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "density/field_grid.h"
#include "surface/disjoint_sets.h"

namespace leafhull {
namespace {

/// The number of a node, a piece of the space below T. Node 0 reaches to infinity; then come the
/// pieces in evaluated bricks, then stretches of blocks that are neither evaluated nor inside.
using Node = DisjointSets::Index;

constexpr std::uint64_t kFirstZ = 0x0101010101010101, kLastZ = kFirstZ << 7;
constexpr SampleBits kAll = [] {
  SampleBits bits{};
  bits.fill(~std::uint64_t{0});
  return bits;
}();

SampleBits below(const Brick& negated, float iso) {
  SampleBits bits{};
  const float* value = negated.buffer().data();
  for (std::uint64_t& layer : bits) {
    for (unsigned bit = 0; bit < 64; ++bit) layer |= std::uint64_t{!(*value++ < iso)} << bit;
  }
  return bits;
}

/// Grows samples of a layer to all open samples that they are connected to.
std::uint64_t spread(std::uint64_t from, std::uint64_t open) {
  for (;;) {
    const std::uint64_t along_y = from << 8 | from >> 8;
    const std::uint64_t along_z = (from & ~kLastZ) << 1 | (from & ~kFirstZ) >> 1;
    const std::uint64_t wider = (from | along_y | along_z) & open;
    if (wider == from) return from;
    from = wider;
  }
}

/// Takes one piece from `open`: the first sample and all those connected to it.
SampleBits take_piece(SampleBits& open) {
  const auto first = std::find_if(open.begin(), open.end(), [](auto layer) { return layer != 0; });
  SampleBits piece{};
  piece[static_cast<std::size_t>(first - open.begin())] = *first & -*first;
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t x = 0; x < kBrickEdge; ++x) {
      const std::uint64_t beside =
          (x > 0 ? piece[x - 1] : 0) | (x + 1 < kBrickEdge ? piece[x + 1] : 0);
      const std::uint64_t layer = spread((piece[x] | beside) & open[x], open[x]);
      grows = grows || layer != piece[x];
      piece[x] = layer;
    }
  }
  for (std::size_t x = 0; x < kBrickEdge; ++x) open[x] &= ~piece[x];
  return piece;
}

/// The pieces of the space below T in each evaluated brick.
struct Pieces {
  std::vector<Node> first;  ///< of each brick, then one past the last piece
  std::vector<SampleBits> samples;
};

Pieces pieces_of(const Field& field) {
  constexpr std::size_t kChunk = 64;  // bricks
  const std::span<const Brick* const> bricks = bricks_of(field);
  const float iso = field.iso_value();
  Pieces pieces;
  pieces.first.resize(bricks.size() + 1);
  std::vector<std::vector<SampleBits>> chunks((bricks.size() + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    const std::size_t end = std::min((c + 1) * kChunk, bricks.size());
    for (std::size_t b = c * kChunk; b < end; ++b) {
      const std::size_t before = chunks[c].size();
      for (SampleBits open = below(*bricks[b], iso); open != SampleBits{};) {
        chunks[c].push_back(open == kAll ? std::exchange(open, {}) : take_piece(open));
      }
      pieces.first[b + 1] = static_cast<Node>(chunks[c].size() - before);
    }
  });
  pieces.first[0] = 1;
  std::partial_sum(pieces.first.begin(), pieces.first.end(), pieces.first.begin());
  pieces.samples.resize(pieces.first.back() - 1);
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    std::copy(chunks[c].begin(), chunks[c].end(),
              pieces.samples.begin() + pieces.first[c * kChunk] - 1);
  });
  return pieces;
}

/// Blocks of brick size along z, [low, high), counted in blocks: one evaluated brick, blocks
/// inside, or blocks below T.
struct Stretch {
  std::int32_t low, high;
  Node first, nodes;
};

constexpr std::int32_t kFarBelow = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kFarAbove = std::numeric_limits<std::int32_t>::max();
constexpr Stretch kWorld[] = {{kFarBelow, kFarAbove, 0, 1}};

/// All blocks at one x and y, also counted in blocks, as stretches without gaps.
struct Column {
  std::int32_t x, y;
  std::size_t first, end;
};

/// Space in columns. Those that hold neither a brick nor a block inside belong to the world and are
/// left out, so that parts far apart take no more memory than parts close together.
struct Space {
  std::vector<Column> columns;  ///< ascending
  std::vector<Stretch> stretches;
  Node nodes;

  std::span<const Stretch> of(const Column& column) const {
    return std::span(stretches).subspan(column.first, column.end - column.first);
  }
  /// The column at x and y; null if it belongs to the world.
  const Column* find(std::int32_t x, std::int32_t y) const {
    const auto found =
        std::lower_bound(columns.begin(), columns.end(), std::pair(x, y),
                         [](const Column& c, const auto& at) { return std::pair(c.x, c.y) < at; });
    return found != columns.end() && found->x == x && found->y == y ? &*found : nullptr;
  }
};

struct Occupied {
  std::int32_t x, y;
  Stretch stretch;
};

std::vector<Occupied> occupied_by(const Field& field, const Pieces& pieces) {
  const std::span<const Brick* const> bricks = bricks_of(field);
  std::vector<Occupied> occupied;
  occupied.reserve(bricks.size());
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    const openvdb::Coord at = bricks[b]->origin() >> 3;
    const Node first = pieces.first[b];
    occupied.push_back({at.x(), at.y(), {at.z(), at.z() + 1, first, pieces.first[b + 1] - first}});
  }
  for (const Block& block : field.inside()) {
    const auto [x, y, z] = block.origin;
    for (int i = 0; i < block.edge; i += kBrickEdge) {
      for (int j = 0; j < block.edge; j += kBrickEdge) {
        occupied.push_back({(x + i) / kBrickEdge,
                            (y + j) / kBrickEdge,
                            {z / kBrickEdge, (z + block.edge) / kBrickEdge, 0, 0}});
      }
    }
  }
  tbb::parallel_sort(occupied, [](const Occupied& a, const Occupied& b) {
    return std::tie(a.x, a.y, a.stretch.low) < std::tie(b.x, b.y, b.stretch.low);
  });
  return occupied;
}

Space space_of(const Field& field, const Pieces& pieces) {
  const std::vector<Occupied> occupied = occupied_by(field, pieces);
  Space space;
  space.nodes = pieces.first.back();
  space.stretches.reserve(occupied.size());
  for (std::size_t i = 0; i < occupied.size(); ++i) {
    const auto& [x, y, stretch] = occupied[i];
    const bool begins = i == 0 || x != occupied[i - 1].x || y != occupied[i - 1].y;
    if (begins) {
      space.columns.push_back({x, y, space.stretches.size(), 0});
      space.stretches.push_back({kFarBelow, stretch.low, 0, 1});
    } else if (const std::int32_t last = space.stretches.back().high; last < stretch.low) {
      space.stretches.push_back({last, stretch.low, space.nodes++, 1});
    }
    space.stretches.push_back(stretch);
    const bool ends = i + 1 == occupied.size() || x != occupied[i + 1].x || y != occupied[i + 1].y;
    if (!ends) continue;
    space.stretches.push_back({stretch.high, kFarAbove, 0, 1});
    space.columns.back().end = space.stretches.size();
  }
  return space;
}

/// Whether samples of a block and of the next one along an axis touch.
bool touch(const SampleBits& low, const SampleBits& high, int axis) {
  if (axis == 0) return (low.back() & high.front()) != 0;
  std::uint64_t both = 0;
  for (std::size_t x = 0; x < kBrickEdge; ++x) {
    both |= axis == 1 ? low[x] >> 56 & high[x] : low[x] >> 7 & kFirstZ & high[x];
  }
  return both != 0;
}

/// Unites nodes that are connected across the faces of bricks.
class Connections {
 public:
  Connections(const Space& space, const Pieces& pieces)
      : space_(space), pieces_(pieces), sets_(space.nodes) {
    tbb::parallel_for(std::size_t{0}, space.columns.size(),
                      [&](std::size_t c) { connect(space.columns[c]); });
  }
  /// For each node whether it is connected to node 0.
  std::vector<Node> lowest() && { return std::move(sets_).lowest(); }

 private:
  void connect(const Column& column) {
    const std::span<const Stretch> here = space_.of(column);
    for (std::size_t i = 1; i < here.size(); ++i) connect(here[i - 1], here[i], 2);
    for (int axis = 0; axis < 2; ++axis) {
      const int dx = axis == 0, dy = axis == 1;
      if (!space_.find(column.x - dx, column.y - dy)) connect(kWorld, here, axis);
      const Column* next = space_.find(column.x + dx, column.y + dy);
      connect(here, next ? space_.of(*next) : std::span(kWorld), axis);
    }
  }

  /// Connects two adjacent columns of stretches.
  void connect(std::span<const Stretch> low, std::span<const Stretch> high, int axis) {
    for (auto a = low.begin(), b = high.begin(); a != low.end() && b != high.end();) {
      connect(*a, *b, axis);
      const std::int32_t end = std::min(a->high, b->high);
      a += a->high == end;
      b += b->high == end;
    }
  }

  void connect(const Stretch& low, const Stretch& high, int axis) {
    for (Node a = low.first; a < low.first + low.nodes; ++a) {
      for (Node b = high.first; b < high.first + high.nodes; ++b) {
        if (touch(samples(a), samples(b), axis)) sets_.unite(a, b);
      }
    }
  }

  const SampleBits& samples(Node node) const {
    const bool in_brick = node > 0 && node <= pieces_.samples.size();
    return in_brick ? pieces_.samples[node - 1] : kAll;
  }

  const Space& space_;
  const Pieces& pieces_;
  DisjointSets sets_;
};

}  // namespace

Field fill_hollows(Field field) {
  const Pieces pieces = pieces_of(field);
  const Space space = space_of(field, pieces);
  const std::vector<Node> lowest = Connections(space, pieces).lowest();
  const auto is_hollow = [&](Node node) { return lowest[node] != 0; };

  std::vector<BrickPart> parts;
  for (std::size_t b = 0; b < bricks_of(field).size(); ++b) {
    BrickPart part{b, {}};
    for (Node node = pieces.first[b]; node < pieces.first[b + 1]; ++node) {
      if (!is_hollow(node)) continue;
      const SampleBits& piece = pieces.samples[node - 1];
      std::transform(piece.begin(), piece.end(), part.samples.begin(), part.samples.begin(),
                     std::bit_or<>());
    }
    if (part.samples != SampleBits{}) parts.push_back(part);
  }
  std::vector<Block> blocks;
  for (const Column& column : space.columns) {
    for (const auto& [low, high, first, nodes] : space.of(column)) {
      if (nodes == 0 || first < pieces.first.back() || !is_hollow(first)) continue;
      for (std::int32_t z = low; z < high; ++z) {
        blocks.push_back({{column.x * kBrickEdge, column.y * kBrickEdge, z * kBrickEdge}});
      }
    }
  }
  if (!parts.empty() || !blocks.empty()) field.raise(parts, blocks);
  return field;
}

}  // namespace leafhull
