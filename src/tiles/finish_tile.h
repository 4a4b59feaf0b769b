// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/evaluate.h"
#include "surface/brick_mesher.h"
#include "tiles/level.h"
#include "tiles/tile.h"

namespace leafhull {

/// Makes a tile's surface from the polygons of its cells: drops small pieces that end within the
/// tile, moves vertices onto N = T, and lists what reaches a seam.
void finish_tile(OwnedPolygons part, DensityFunction& density, const ForestLevel& level,
                 const Lattice& lattice, const SampleBox& own, TileSurface& surface);

}  // namespace leafhull
