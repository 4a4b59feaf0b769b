// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "forest/forest_folder.h"
#include "forest/seam_file.h"
#include "forest/store.h"

namespace leafhull {

/// The tiles of a forest that are all done, ascending.
class StoredTiles {
 public:
  /// @throws Error internal: one is not done.
  StoredTiles(Store& store, std::span<const TileId> tiles, int tile_edge);

  std::size_t size() const { return records_.size(); }
  const TileRecord& operator[](std::size_t tile) const { return *records_[tile]; }
  ForestFolder& folder() const { return folder_; }

  // From the disk. @throws Error input: the file is damaged.
  Seam seam(std::size_t tile) const;
  std::string mesh_file(std::size_t tile) const;
  /// `seam` gives up what it holds of the mesh.
  Mesh mesh(std::size_t tile, Seam& seam) const;

  /// The tile that owns a vertex which another of this level has borrowed.
  /// @throws Error internal: there is none.
  std::size_t owner(int level, const SeamVertex& vertex) const;

 private:
  ForestFolder& folder_;
  int tile_edge_;
  std::vector<const TileRecord*> records_;
};

/// Visits every borrowed vertex of a tile together with its owner and what the owner lends, and
/// asks for one owner's seam after the other.
/// @throws Error internal: an owner lends no such vertex, so the surface would have a crack.
void for_each_borrowed(const StoredTiles& tiles, std::size_t tile, const Seam& seam,
                       const std::function<Seam(std::size_t owner)>& seam_of,
                       const std::function<void(const SeamVertex& borrowed, std::size_t owner,
                                                const SeamVertex& lent)>& visit);

}  // namespace leafhull
