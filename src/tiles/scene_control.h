// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "leafhull/ranks.h"
#include "tiles/compute_tile.h"
#include "tiles/tile_plan.h"

namespace leafhull {

/// Called with how many of the tiles are done.
using TilesDone = std::function<void(std::size_t done, std::size_t all)>;

/// Control over the whole scene: m and s of N_iso over all leaf vertices, neighbours included, and
/// T for a coverage of N there. It takes two passes over the tiles, which the ranks share; sums are
/// of integers, so the result depends on neither ranks nor tiles. Sets `scene_statistics` and
/// `threshold`. T for a coverage is the lower end of the last of 2^16 steps per power of two that
/// still leaves the coverage above it. Collective.
void control_over_scene(const TilePlan& plan, const ForestLevel* finest, ForestLevel& level,
                        Device& device, Ranks& ranks, const TilesDone& advance);

}  // namespace leafhull
