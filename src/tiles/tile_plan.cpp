// SPDX-License-Identifier: Apache-2.0
#include "tiles/tile_plan.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "leafhull/error.h"
#include "text/numbers.h"
#include "tiles/tile_count.h"
#include "tiles/tree_map.h"

namespace leafhull {
namespace {

constexpr int kEdges[] = {kTileEdge, kTileEdge / 2, kTileEdge / 4};
/// Fixed memory: the program, its libraries and compiled kernels, and batches of lists.
constexpr double kFixedBytes = 400.0 * (1 << 20);
/// Memory for a finished tile: its records, and its lines of journal, manifest and report.
constexpr double kBytesPerTile = 4000;
/// Memory for a kernel: on the lattice, in scene order and hash order, and the hash itself.
constexpr double kBytesPerKernel = 150;
/// Memory for a sample with polygons and mesh; and the most of a tile's samples evaluated.
constexpr double kBytesPerSample = 26, kShareOfSamples = 0.5;

struct Range {
  Coord low, high;  // both included
};

struct Hash {
  std::size_t operator()(const Coord& c) const {
    const auto mix = [](std::uint64_t h, std::int32_t v) {
      return (h ^ static_cast<std::uint32_t>(v)) * 0x9e3779b97f4a7c15;
    };
    return mix(mix(mix(0x243f6a88, c.x), c.y), c.z);
  }
};

Box reached_box(const PlacedTree& tree, const ForestLevel& level) {
  const ForestModel& model = level.models[tree.model];
  return reached_box(tree, model.bounds, model.reach, level.voxel_size);
}

/// Where a tree counts: in control over the scene, also for the radii of any kernel it reaches.
Box heard_box(const Box& reached, const ForestLevel& level) {
  const double r = level.scope == ControlScope::scene ? level.reach : 0;
  return {reached.low - Vec3d(r, r, r), reached.high + Vec3d(r, r, r)};
}

Range tiles_in(const Box& box, double side) {
  const auto at = [&](double v) { return static_cast<std::int32_t>(std::floor(v / side)); };
  return {{at(box.low.x), at(box.low.y), at(box.low.z)},
          {at(box.high.x), at(box.high.y), at(box.high.z)}};
}

template <class Visit>
void for_each_tile(const Range& range, Visit&& visit) {
  for (int x = range.low.x; x <= range.high.x; ++x) {
    for (int y = range.low.y; y <= range.high.y; ++y) {
      for (int z = range.low.z; z <= range.high.z; ++z) visit(Coord{x, y, z});
    }
  }
}

/// The share of a box that lies in a tile.
double share_in(const Box& box, Coord tile, double side) {
  const auto along = [&](double low, double high, int at) {
    const double begin = std::max(low, at * side), end = std::min(high, (at + 1) * side);
    return std::clamp((end - begin) / (high - low), 0.0, 1.0);
  };
  return along(box.low.x, box.high.x, tile.x) * along(box.low.y, box.high.y, tile.y) *
         along(box.low.z, box.high.z, tile.z);
}

double bytes_of_models(std::span<const ForestLevel> levels) {
  double bytes = 0;
  for (const ForestLevel& level : levels) {
    for (const ForestModel& model : level.models) {
      bytes += static_cast<double>(model.leaves.size()) *
               (sizeof(LeafPoint) + sizeof(Kernel) + 2 * sizeof(float));
    }
  }
  return bytes;
}

}  // namespace

TilePlan::TilePlan(const ForestLevel& level, int edge) : edge_(edge) {
  const double side = edge * level.voxel_size;
  struct Count {
    double weight = 0;
    std::size_t trees = 0, next = 0;
  };
  std::unordered_map<Coord, Count, Hash> counts;
  for (const PlacedTree& tree : level.trees) {
    const Box box = reached_box(tree, level);
    const auto kernels = static_cast<double>(level.models[tree.model].kernels.size());
    for_each_tile(tiles_in(box, side),
                  [&](Coord at) { counts[at].weight += kernels * share_in(box, at, side); });
  }
  const auto for_each_place = [&](const auto& visit) {
    for (std::uint32_t i = 0; i < level.trees.size(); ++i) {
      const Box box = heard_box(reached_box(level.trees[i], level), level);
      for_each_tile(tiles_in(box, side), [&](Coord at) {
        if (const auto tile = counts.find(at); tile != counts.end()) visit(i, tile->second);
      });
    }
  };
  for_each_place([](std::uint32_t, Count& count) { ++count.trees; });
  for (const auto& [at, count] : counts) tiles_.push_back({level.level, at});
  std::sort(tiles_.begin(), tiles_.end());

  first_.push_back(0);
  for (const TileId& tile : tiles_) {
    Count& count = counts[tile.at];
    count.next = first_.back();
    first_.push_back(first_.back() + count.trees);
    weights_.push_back(static_cast<float>(count.weight));
  }
  trees_.resize(first_.back());
  for_each_place([&](std::uint32_t i, Count& count) { trees_[count.next++] = i; });
}

double TilePlan::heaviest() const {
  return weights_.empty() ? 0 : *std::max_element(weights_.begin(), weights_.end());
}

int tile_edge(std::span<const ForestLevel> levels, std::optional<int> asked, std::uint64_t memory,
              const std::filesystem::path& folder) {
  const double left = static_cast<double>(memory) - kFixedBytes - bytes_of_models(levels) -
                      100.0 * static_cast<double>(levels.front().trees.size());
  double needed = 0;
  for (const int edge : asked ? std::span<const int>(&*asked, 1) : std::span<const int>(kEdges)) {
    double tiles = 0, heaviest = 0;
    for (const ForestLevel& level : levels) {
      const TilePlan plan(level, edge);
      tiles += static_cast<double>(plan.size());
      heaviest = std::max(heaviest, plan.heaviest());
    }
    check_room_for_tiles(tiles, levels.front().voxel_size, folder);
    const double samples = std::pow(edge + 2.0 * kBrickEdge, 3) * kShareOfSamples;
    // The brick around the tile holds kernels as well.
    const double around = std::pow(1 + 2.0 * kBrickEdge / edge, 2);
    needed = tiles * kBytesPerTile +
             kTilesAtOnce * (heaviest * around * kBytesPerKernel + samples * kBytesPerSample);
    if (needed <= left) return edge;
  }
  constexpr double kGiB = 1 << 30;
  throw Error(
      ErrorCode::usage,
      "two of the densest tiles need about " +
          significant((needed + static_cast<double>(memory) - left) / kGiB, 3) +
          " GiB with the models, and --memory is " +
          significant(static_cast<double>(memory) / kGiB, 3) + " GiB",
      asked ? "Raise --memory, or lower --tile." : "Raise --memory, or lower --voxel-size.");
}

SampleBox samples_around(int edge) {
  const int low = -kBrickEdge, high = edge + kBrickEdge;
  return {{low, low, low}, {high, high, high}};
}

Lattice tile_lattice(const TileId& tile, double voxel_size, int edge) {
  const auto at = [&](std::int32_t v) { return std::int64_t{v} * edge; };
  return {voxel_size, {at(tile.at.x), at(tile.at.y), at(tile.at.z)}};
}

}  // namespace leafhull
