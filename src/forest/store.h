// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "forest/forest_folder.h"
#include "forest/tile_record.h"
#include "runs/sealed_json.h"
#include "runs/sealed_lines.h"
#include "tiles/tile.h"

namespace leafhull {

/// Where the tiles of a forest are kept while it is computed: work/ in its folder, a mesh and a
/// seam file per tile, a journal per writer with a line for each tile that is on the disk, and
/// plan.json, which says what forest it is.
class Store {
 public:
  /// Opens the folder, or makes it where it is missing. Many processes may open one store, each
  /// with its own `writer`, which names its journal: letters, digits, "-" and "_". Of a run's
  /// ranks, one opens it as asked, then the others with `resume`, as a range always does.
  /// @param plan    what the result depends on; any difference makes it another forest.
  /// @param resume  continues where tiles are done; without it no tile may be there.
  /// @param restart removes a forest that is there, and nothing else. One that was cut off in it is
  ///                removed without it too.
  /// @throws Error usage: the folder holds another forest (what differs), or an unfinished or a
  ///         finished one without `resume`, or files from elsewhere; a journal that another process
  ///         writes; input: a plan, a journal or a manifest that is damaged or of another program,
  ///         or a finished forest that lacks a file; output: it cannot be made or written to.
  Store(const std::filesystem::path& folder, const Json& plan, const std::string& writer,
        bool resume, bool restart);

  /// Every tile that is on the disk, by any writer: read when the store was opened and at
  /// refresh(). One that has lost a file, or whose file has another size, is not among them.
  const std::map<TileId, TileRecord>& done() const { return done_; }
  /// @throws Error input: a journal that is damaged.
  void refresh();
  /// What control over the scene has found, by level; empty until it is kept. It need not be
  /// computed again. @throws Error input: damaged.
  std::optional<Json> control() const;
  void keep_control(const Json& levels);
  /// Whether manifest.json is there: the forest is finished, and nothing is kept any more.
  bool finished() const { return finished_; }
  /// Whether the finished forest has this file beside its tiles.
  bool holds(const std::string& file) const { return files_.contains(file); }
  /// What was found damaged and is computed again.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Keeps a tile: mesh and seam, then its line. Returns the record with its files and all that the
  /// surface tells. One call at a time. @throws Error output; the tile then does not count.
  TileRecord put(const TileSurface& surface, TileRecord record);

  ForestFolder& folder() { return folder_; }
  const Json& plan() const { return plan_; }

 private:
  void open(bool resume, bool restart);
  void open_finished(bool resume);
  void open_plan();
  TileRecord tile_of(const std::string& line, const std::string& where) const;

  ForestFolder folder_;
  Json plan_;  ///< as read back from the disk
  std::string plan_checksum_;
  bool finished_ = false;
  Json files_;  ///< those of a finished forest, by name
  std::optional<SealedLines> journal_;
  std::map<TileId, TileRecord> done_;
  std::vector<std::string> warnings_;
};

/// Writes a file of the result into the folder, through work/, so that nothing half-written
/// outlives the forest. @throws Error output.
FileRecord put_file(Store& store, const std::string& name, const RunFolder::Fill& fill);

/// Pieces of surface that are to be dropped because all tiles' parts together are small.
struct SmallPieces {
  /// Twelve times the least volume that stays, by level; where 0 or missing, all stay.
  std::vector<ExactVolume> least;
};

/// The result, in place.
struct FinishedForest {
  std::vector<TileRecord> tiles;         ///< those with a surface, as they are there, ascending
  std::uint64_t dropped_components = 0;  ///< small pieces that reached over seams
  std::optional<FileRecord> single;
};

/// Makes the result from a store in which every tile of `tiles` is done: drops small pieces that
/// reach over seams, puts the tiles in place (tiles/LEVEL/X_Y_Z.glb), and welds those of level 0
/// into `single` (.glb or .ply, relative to the folder) where asked for. May be cut off at any
/// moment and called again. Holds a few tiles at a time.
/// @param tile_edge cells along a tile's edge.
/// @throws Error input: a tile's file is damaged; it is removed, so that a store that is opened
///         again lacks the tile; output; internal: a tile that is not done, or tiles that do not
///         fit together.
FinishedForest put_in_place(Store& store, std::span<const TileId> tiles, int tile_edge,
                            const SmallPieces& small,
                            const std::optional<std::filesystem::path>& single);

/// Writes manifest.json, which ends the forest, and removes work/. `files`: others that belong to
/// it, by name, tileset.json among them.
void finish_store(Store& store, std::span<const TileRecord> tiles,
                  const std::map<std::string, FileRecord>& files);

}  // namespace leafhull
