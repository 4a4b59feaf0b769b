// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "forest/stored_tiles.h"

namespace leafhull {

/// Writes the tiles of level 0, already in place, as one mesh that shares the vertices of the
/// seams: tiles ascending, each with its own vertices and its triangles in their order.
/// @param file .glb or .ply.
FileRecord weld(const StoredTiles& tiles, const std::filesystem::path& file);

}  // namespace leafhull
