// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/evaluate.h"
#include "surface/brick_mesher.h"
#include "tiles/level.h"
#include "tiles/tile.h"

namespace leafhull {

/// The polygons of a tile's cells as its surface: pieces that are small and end within the tile are
/// dropped, vertices moved onto N = T, and what reaches a seam is listed.
void finish_tile(OwnedPolygons part, DensityFunction& density, const ForestLevel& level,
                 const Lattice& lattice, const SampleBox& own, TileSurface& surface);

}  // namespace leafhull
