// SPDX-License-Identifier: Apache-2.0
#include "tiles/tile_count.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <cmath>

#include "density/lattice.h"
#include "leafhull/error.h"
#include "text/numbers.h"
#include "tiles/tree_map.h"

namespace leafhull {
namespace {

/// Lattice coordinates are 32 bits, with room for neighbours.
constexpr double kMostCoordinate = 1 << 30;
/// The most tiles, whatever the file system says.
constexpr double kMostTiles = 1e7;

double number_of_tiles(const Box& box, double side) {
  const auto along = [&](double low, double high) {
    return std::floor(high / side) - std::floor(low / side) + 1;
  };
  return along(box.low.x, box.high.x) * along(box.low.y, box.high.y) * along(box.low.z, box.high.z);
}

double farthest(const Box& box) {
  return std::max({std::fabs(box.low.x), std::fabs(box.low.y), std::fabs(box.low.z),
                   std::fabs(box.high.x), std::fabs(box.high.y), std::fabs(box.high.z)});
}

std::string short_number(double value) { return significant(value, 3); }

}  // namespace

Box reached_box(const PlacedTree& tree, const Box& bounds, double reach, double voxel_size) {
  const TreeMap map(tree);
  Box box = map(bounds);
  const double r = reach * map.stretch() + (kBrickEdge + 2) * voxel_size;
  box.low = box.low - Vec3d(r, r, r);
  box.high = box.high + Vec3d(r, r, r);
  return box;
}

void check_tile_count(const Scene& scene, std::span<const LeafSet> models,
                      std::span<const Options> shapes, double voxel_size, int edge,
                      const std::filesystem::path& folder) {
  const double side = edge * voxel_size;
  double tiles = 0;
  Box all;
  for (const PlacedTree& tree : scene.trees) {
    const LeafSet& leaves = models[tree.model];
    const double reach = radius_max_in_model_units(leaves, shapes[tree.model]);
    const Box box = reached_box(tree, leaves.bounds, reach, voxel_size);
    all.include(box.low);
    all.include(box.high);
    tiles += number_of_tiles(box, side);
  }
  if (farthest(all) / voxel_size > kMostCoordinate) {
    throw Error(ErrorCode::usage,
                "the scene reaches " + short_number(farthest(all)) +
                    " units from the origin, more than 2^30 voxels of " + short_number(voxel_size),
                "Raise --voxel-size, or move the scene to the origin.");
  }
  // Trees share tiles: there are no more than in the box around all.
  check_room_for_tiles(std::min(tiles, number_of_tiles(all, side)), voxel_size, folder);
}

void check_room_for_tiles(double tiles, double voxel_size, const std::filesystem::path& folder) {
  double room = kMostTiles;
  std::filesystem::path place = std::filesystem::absolute(folder);
  while (place.has_relative_path() && !std::filesystem::exists(place)) place = place.parent_path();
  struct statvfs status {};
  // Some file systems make their inodes as they need them and say 0.
  if (::statvfs(place.c_str(), &status) == 0 && status.f_files > 0) {
    room = std::min(room, static_cast<double>(status.f_favail) / 3);  // mesh, seam, its place
  }
  if (tiles <= room) return;
  throw Error(ErrorCode::usage,
              "voxels of " + short_number(voxel_size) + " need up to " + short_number(tiles) +
                  " tiles, but there is room for " + short_number(room) + " in " + folder.string(),
              "Raise --voxel-size or --tile.");
}

}  // namespace leafhull
