// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "leafhull/device.h"
#include "tiles/level.h"
#include "tiles/tile.h"
#include "tiles/tile_plan.h"

namespace leafhull {

/// A tile's part of the surface N = T, with N summed over all trees. It depends on the scene and
/// the level alone: another edge gives the same vertices and triangles.
TileSurface compute_tile(const ForestLevel& level, const TileTask& task, Device& device);

/// N_iso, neighbours included, at the leaf points in a tile.
std::vector<WeightedDensity> isotropic_density_in(const ForestLevel& level, const TileTask& task,
                                                  Device& device);

/// N at the places on leaves in a tile.
std::vector<WeightedDensity> density_in(const ForestLevel& level, const TileTask& task,
                                        Device& device);

}  // namespace leafhull
