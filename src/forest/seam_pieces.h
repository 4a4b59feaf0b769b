// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "forest/stored_tiles.h"

namespace leafhull {

/// Pieces of surface that cross seams and are too small.
struct DroppedPieces {
  std::vector<std::vector<std::uint32_t>> of_tile;  ///< indices into Seam::components
  std::uint64_t count = 0;
};

/// Joins the components that tiles share and measures the volume that they enclose together.
DroppedPieces find_small_pieces(const StoredTiles& tiles, const SmallPieces& small);

}  // namespace leafhull
