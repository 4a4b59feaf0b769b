// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "surface/polygonise.h"
#include "tiles/tile.h"

namespace leafhull {

/// Twelve times the volume of each piece of surface, or a part's share of it, in 1 / 2^42 voxels,
/// by the piece's lowest point, ascending. Parts of a closed piece add up to its volume, in any
/// order, on lattices with any anchors. Points are multiples of 2^-14 voxels, as mesh_bricks gives
/// those of a part; others are rounded.
std::vector<std::pair<std::uint32_t, ExactVolume>> exact_volumes(
    const Polygons& polygons, const Lattice& lattice, const std::vector<std::uint32_t>& root);
std::vector<std::pair<std::uint32_t, ExactVolume>> exact_volumes(const Polygons& polygons,
                                                                 const Lattice& lattice);

}  // namespace leafhull
