// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "forest/tile.h"
#include "leafhull/vec.h"
#include "runs/checksum.h"

namespace leafhull {

/// What is known of a tile once it is on the disk.
struct TileRecord {
  TileId id;
  FileRecord mesh;  ///< none where the tile holds no surface
  FileRecord seam;
  std::uint64_t vertices = 0, triangles = 0, own_vertices = 0;
  Vec3d origin;  ///< of the mesh
  Box bounds;    ///< of the mesh, scene units
  std::uint64_t leaf_vertices = 0, gathered = 0, evaluated_voxels = 0, dropped_components = 0;
  // Of the run alone, not of the result.
  double seconds = 0;
  std::uint64_t resident_bytes = 0;  ///< once it was computed
  int rank = 0;
};

}  // namespace leafhull
