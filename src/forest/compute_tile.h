// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "forest/level.h"
#include "forest/tile.h"
#include "leafhull/device.h"
#include "leafhull/scene.h"

namespace leafhull {

/// A tile to compute: `trees` are those that may reach it, ascending.
struct TileTask {
  TileId id;
  int edge = 128;  ///< cells
  std::span<const std::uint32_t> trees;
};

/// The surface N = T of all trees' densities together in a tile. It depends on the scene and the
/// level alone: another edge gives the same vertices and triangles.
TileSurface compute_tile(const Scene& scene, const ForestLevel& level, const TileTask& task,
                         Device& device);

/// N_iso, neighbours included, at the leaf points in a tile.
std::vector<WeightedDensity> isotropic_density_in(const Scene& scene, const ForestLevel& level,
                                                  const TileTask& task, Device& device);

/// N at the places on leaves in a tile.
std::vector<WeightedDensity> density_in(const Scene& scene, const ForestLevel& level,
                                        const TileTask& task, Device& device);

}  // namespace leafhull
