// SPDX-License-Identifier: Apache-2.0
#include "forest/plan.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <unordered_map>

#include "forest/tree_map.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

constexpr int kEdges[] = {128, 64, 32};
/// Lattice coordinates are 32 bits, with room for neighbours.
constexpr double kMostCoordinate = 1 << 30;
constexpr double kMostTiles = 1e7;
/// Beside models and tiles: the program, its libraries and compiled kernels, and batches of lists.
constexpr double kFixedBytes = 400.0 * (1 << 20);
/// Of a kernel: on the lattice, in order of the scene and of the hash, and the hash itself.
constexpr double kBytesPerKernel = 150;
/// Of a sample, with polygons and mesh; and which share of a tile's samples is evaluated at most.
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

/// Where a tree's density may be needed: within reach of a tile's samples and the brick around
/// them.
Box reached_box(const PlacedTree& tree, const ForestLevel& level) {
  const ForestModel& model = level.models[tree.model];
  const TreeMap map(tree);
  Box box = map(model.bounds);
  const double r = model.reach * map.stretch() + (kBrickEdge + 2) * level.voxel_size;
  box.low = box.low - Vec3d(r, r, r);
  box.high = box.high + Vec3d(r, r, r);
  return box;
}

double tiles_along(double low, double high, double side) {
  return std::floor(high / side) - std::floor(low / side) + 1;
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
               (sizeof(LeafVertex) + sizeof(Kernel) + 2 * sizeof(float));
    }
  }
  return bytes;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

TilePlan::TilePlan(const Scene& scene, const ForestLevel& level, int edge) {
  const double side = edge * level.voxel_size;
  struct Count {
    std::size_t trees = 0;
    double weight = 0;
  };
  std::unordered_map<Coord, Count, Hash> counts;
  for (const PlacedTree& tree : scene.trees) {
    const Box box = reached_box(tree, level);
    const auto kernels = static_cast<double>(level.models[tree.model].kernels.size());
    for_each_tile(tiles_in(box, side), [&](Coord at) {
      Count& count = counts[at];
      ++count.trees;
      count.weight += kernels * share_in(box, at, side);
    });
  }
  for (const auto& [at, count] : counts) tiles_.push_back({level.level, at});
  std::sort(tiles_.begin(), tiles_.end());

  first_.push_back(0);
  std::unordered_map<Coord, std::size_t, Hash> next;
  for (const TileId& tile : tiles_) {
    const Count& count = counts[tile.at];
    next[tile.at] = first_.back();
    first_.push_back(first_.back() + count.trees);
    weights_.push_back(static_cast<float>(count.weight));
  }
  trees_.resize(first_.back());
  for (std::uint32_t i = 0; i < scene.trees.size(); ++i) {
    const Box box = reached_box(scene.trees[i], level);
    for_each_tile(tiles_in(box, side), [&](Coord at) { trees_[next[at]++] = i; });
  }
}

double TilePlan::heaviest() const {
  return weights_.empty() ? 0 : *std::max_element(weights_.begin(), weights_.end());
}

double most_tiles(const Scene& scene, const ForestLevel& level, int edge) {
  const double side = edge * level.voxel_size;
  double tiles = 0;
  Box all;
  for (const PlacedTree& tree : scene.trees) {
    const Box box = reached_box(tree, level);
    all.include(box.low);
    all.include(box.high);
    tiles += tiles_along(box.low.x, box.high.x, side) * tiles_along(box.low.y, box.high.y, side) *
             tiles_along(box.low.z, box.high.z, side);
  }
  const double farthest =
      std::max({std::fabs(all.low.x), std::fabs(all.low.y), std::fabs(all.low.z),
                std::fabs(all.high.x), std::fabs(all.high.y), std::fabs(all.high.z)});
  if (farthest / level.voxel_size > kMostCoordinate) {
    throw Error(ErrorCode::usage,
                "the scene reaches " + number(farthest) +
                    " units from the origin, more than 2^30 " + "voxels of " +
                    number(level.voxel_size),
                "Raise --voxel-size, or move the scene to the origin.");
  }
  return std::min(tiles, tiles_along(all.low.x, all.high.x, side) *
                             tiles_along(all.low.y, all.high.y, side) *
                             tiles_along(all.low.z, all.high.z, side));
}

void check_tile_count(double tiles, double voxel_size, const std::filesystem::path& folder) {
  double room = kMostTiles;
  std::filesystem::path place = std::filesystem::absolute(folder);
  while (!place.empty() && !std::filesystem::exists(place)) place = place.parent_path();
  struct statvfs status {};
  // Some file systems make their inodes as they need them and say 0.
  if (::statvfs(place.c_str(), &status) == 0 && status.f_files > 0) {
    room = std::min(room, static_cast<double>(status.f_favail) / 3);  // mesh, seam, its place
  }
  if (tiles <= room) return;
  throw Error(ErrorCode::usage,
              "voxels of " + number(voxel_size) + " need up to " + number(tiles) +
                  " tiles, and there is room for " + number(room) + " in " + folder.string(),
              "Raise --voxel-size or --tile.");
}

int tile_edge(const Scene& scene, std::span<const ForestLevel> levels, std::optional<int> asked,
              std::uint64_t memory, const std::filesystem::path& folder) {
  const double left = static_cast<double>(memory) - kFixedBytes - bytes_of_models(levels) -
                      100.0 * static_cast<double>(scene.trees.size());
  double needed = 0;
  for (const int edge : asked ? std::span<const int>(&*asked, 1) : std::span<const int>(kEdges)) {
    double tiles = 0, heaviest = 0;
    for (const ForestLevel& level : levels) tiles += most_tiles(scene, level, edge);
    check_tile_count(tiles, levels.front().voxel_size, folder);
    for (const ForestLevel& level : levels) {
      heaviest = std::max(heaviest, TilePlan(scene, level, edge).heaviest());
    }
    const double samples = std::pow(edge + 2.0 * kBrickEdge, 3) * kShareOfSamples;
    // Kernels in the brick around the tile as well.
    const double around = std::pow(1 + 2.0 * kBrickEdge / edge, 2);
    needed = heaviest * around * kBytesPerKernel + samples * kBytesPerSample;
    if (needed <= left) return edge;
  }
  constexpr double kGiB = 1 << 30;
  throw Error(
      ErrorCode::usage,
      "the densest tile needs about " +
          number((needed + static_cast<double>(memory) - left) / kGiB) +
          " GiB with the models, and --memory is " + number(static_cast<double>(memory) / kGiB) +
          " GiB",
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
