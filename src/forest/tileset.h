// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "forest/tile_record.h"

namespace leafhull {

/// tileset.json of OGC 3D Tiles 1.1 for tiles of one level or more: a tile's children are those of
/// the level below within it, which replace it. A tile without a surface has no content, and one
/// without surfaces under it is left out. The root is the tile of the coarsest level that has a
/// surface, or stands without content over all of them. glTF has y up and 3D Tiles z: boxes are
/// turned.
/// @param errors by level: how far, in scene units, its surface may be from what it stands for;
///               ascending.
/// @throws Error empty: no tile has a surface.
/// Source: OGC 22-025r4.
std::string tileset_json(std::span<const TileRecord> tiles, std::span<const double> errors);

}  // namespace leafhull
