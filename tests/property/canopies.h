// SPDX-License-Identifier: Apache-2.0
// Helpers for the trees of a forest, and its canopy tile by tile.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "property/area_measures.h"
#include "property/extractions.h"
#include "tiles/compute_tile.h"
#include "tiles/tile_plan.h"

namespace leafhull::test {

inline PlacedTree placed(std::uint32_t model, Vec3d position, double yaw, double scale) {
  const auto c = static_cast<float>(scale * std::cos(yaw)),
             s = static_cast<float>(scale * std::sin(yaw));
  return {position, {c, 0, s, 0, static_cast<float>(scale), 0, -s, 0, c}, model};
}

inline std::vector<Corners> canopy(const ForestLevel& level, int edge) {
  std::vector<Corners> all;
  const TilePlan plan(level, edge);
  for (std::size_t t = 0; t < plan.size(); ++t) {
    const TileTask task{plan.tiles()[t], edge, plan.trees(t)};
    const std::vector<Corners> part = corners_of(compute_tile(level, task, device()).mesh);
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace leafhull::test
