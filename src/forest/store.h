// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "forest/record.h"
#include "forest/tile.h"

namespace leafhull {

/// Where the tiles of a forest are kept while it is computed: work/ in its folder, a mesh and a
/// seam file per tile, a journal per writer with a line for each tile that is on the disk, and
/// plan.json, which says what forest it is.
class Store {
 public:
  /// Opens the folder, which is made where it is missing. Many processes may open one store, each
  /// as another `writer`, which names its journal.
  /// @param plan   what the result depends on; any difference makes it another forest.
  /// @throws Error usage: the folder holds another forest (what differs), or an unfinished one
  ///         without `resume`, or files from elsewhere; a journal that is damaged, or that another
  ///         process writes; output: it cannot be made or written to.
  Store(const std::filesystem::path& folder, const nlohmann::ordered_json& plan,
        const std::string& writer, bool resume, bool restart);
  ~Store();

  /// Every tile that is on the disk, by any writer: read when the store was opened and at
  /// refresh().
  const std::map<TileId, TileRecord>& done() const;
  void refresh();
  /// Whether manifest.json is there: the forest is finished.
  bool finished() const;

  /// Keeps a tile: mesh and seam under temporary names, synced, renamed, then its line. Returns the
  /// record with its files. @throws Error output; the tile then does not count.
  TileRecord put(const TileSurface& surface, TileRecord record);

  const std::filesystem::path& folder() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Pieces of surface that are to be dropped because all tiles' parts together are small.
struct SmallPieces {
  /// Twelve times the least volume that stays, by level; 0: all stay.
  std::vector<ExactVolume> least;
};

/// What of a finished forest tileset.json and the manifest list.
struct FinishedTile {
  TileId id;
  FileRecord mesh;  ///< at tiles/LEVEL/X_Y_Z.glb
  std::uint64_t vertices = 0, triangles = 0;
  Box bounds;
};

/// Makes the result from a store in which every tile of `tiles` is done: drops small pieces that
/// reach over seams, puts the tiles in place (tiles/LEVEL/X_Y_Z.glb), and welds those of level 0
/// into `single` where asked for. May be cut off at any moment and called again. Holds a few tiles
/// at a time.
std::vector<FinishedTile> put_in_place(const Store& store, std::span<const TileId> tiles,
                                       const SmallPieces& small,
                                       const std::optional<std::filesystem::path>& single);

/// Writes manifest.json, which ends the forest, and removes work/. `files`: others that belong to
/// it, by name, tileset.json among them.
void finish_store(const Store& store, std::span<const FinishedTile> tiles,
                  const std::map<std::string, FileRecord>& files);

/// The checksum of bytes or of a file. @throws Error output: it cannot be read.
FileRecord record_of(std::string_view bytes);
FileRecord record_of_file(const std::filesystem::path& file);

}  // namespace leafhull
