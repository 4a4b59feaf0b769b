// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "forest/stored_tiles.h"

namespace leafhull {

/// What has become of a tile in the result.
struct PlacedTile {
  FileRecord mesh;       ///< at tiles/LEVEL/X_Y_Z.glb; none without triangles
  FileRecord kept_seam;  ///< where it has lost pieces
  std::uint64_t vertices = 0, triangles = 0, own_vertices = 0;
  Box bounds;
};

/// Writes the tiles of level 0 as one mesh in which they share the vertices of their seams: tiles
/// ascending, each with its own vertices and its triangles in their order.
/// @param file .glb or .ply.
FileRecord weld(const StoredTiles& tiles, std::span<const PlacedTile> placed,
                const std::filesystem::path& file);

}  // namespace leafhull
