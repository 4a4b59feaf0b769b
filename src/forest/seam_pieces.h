// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "forest/stored_tiles.h"

namespace leafhull {

/// The pieces of surface that reach over seams and that are too small.
struct DroppedPieces {
  std::vector<std::vector<std::uint32_t>> of_tile;  ///< indices into Seam::components
  std::uint64_t count = 0;
};

/// Brings together the components that tiles share and measures what they enclose in all.
DroppedPieces find_small_pieces(const StoredTiles& tiles, const SmallPieces& small);

}  // namespace leafhull
