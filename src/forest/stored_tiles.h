// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "forest/forest_folder.h"
#include "forest/seam_file.h"
#include "forest/store.h"

namespace leafhull {

/// A finished tile and where its files are.
struct StoredTile {
  TileRecord record;
  bool placed = false;  ///< its mesh is in tiles/
  bool cut = false;     ///< it has lost pieces; its seam is that of the rest
};

/// The tiles of a forest, all of them done, ascending.
class StoredTiles {
 public:
  /// @throws Error internal: one is not done.
  StoredTiles(Store& store, std::span<const TileId> tiles, int tile_edge);

  std::size_t size() const { return tiles_.size(); }
  const StoredTile& operator[](std::size_t tile) const { return tiles_[tile]; }
  StoredTile& operator[](std::size_t tile) { return tiles_[tile]; }
  ForestFolder& folder() const { return folder_; }

  // Both are read from the disk. @throws Error input: the file is damaged.
  Seam seam(std::size_t tile) const;
  std::string mesh_file(std::size_t tile) const;
  /// Moves out of `seam` what it holds of the mesh.
  Mesh mesh(std::size_t tile, Seam& seam) const;

  /// The tile that owns a vertex which another of this level has borrowed.
  /// @throws Error internal: there is none.
  std::size_t owner(int level, const SeamVertex& vertex) const;

 private:
  std::filesystem::path mesh_path(const StoredTile& tile) const;

  ForestFolder& folder_;
  int tile_edge_;
  std::vector<StoredTile> tiles_;
};

/// Visits every borrowed vertex of a tile together with its owner and what the owner lends.
/// @throws Error internal: an owner lends no such vertex, so the surface would have a crack.
void for_each_borrowed(const StoredTiles& tiles, std::size_t tile, const Seam& seam,
                       const std::function<void(const SeamVertex& borrowed, std::size_t owner,
                                                const SeamVertex& lent)>& visit);

}  // namespace leafhull
