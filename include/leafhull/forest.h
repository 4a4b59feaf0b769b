// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "leafhull/api.h"
#include "leafhull/device.h"
#include "leafhull/option_row.h"
#include "leafhull/options.h"
#include "leafhull/output.h"
#include "leafhull/progress.h"
#include "leafhull/scene.h"
#include "leafhull/shape.h"

namespace leafhull {

class Ranks;

enum class Merge { none, canopy };         ///< each model once with instances, or one surface
enum class ControlScope { model, scene };  ///< what m and s are taken over

LEAFHULL_API std::span<const std::string_view> names(Merge);
LEAFHULL_API std::span<const std::string_view> names(ControlScope);

/// Part `part`, 1 to `parts`, of a forest's tiles.
struct TileRange {
  int part = 1, parts = 1;
};

struct ForestOptions {
  Options shape;  ///< as for an extraction; a resolution counts along the largest tree
  Merge merge = Merge::canopy;
  ControlScope control_scope = ControlScope::model;
  int levels = 1;                               ///< levels of abstraction
  ByteCount memory = {std::uint64_t{4} << 30};  ///< the most that a rank may hold
  std::optional<int> tile;                      ///< voxels along a tile's edge; empty: 128, or less
                                                ///< where the memory asks for it
  std::optional<TileRange> range;               ///< only computes these tiles
  bool finish = false;                          ///< only does what follows once all tiles are there
  bool resume = false;   ///< continues what an earlier run left in the folder
  bool restart = false;  ///< removes what an earlier run left there
  /// .glb or .ply, relative to the working folder: all tiles of level 0, welded.
  std::optional<std::filesystem::path> single;
};

LEAFHULL_API void describe(OptionLine& line, const TileRange& value);
LEAFHULL_API void check_value(const OptionLine& line, const TileRange& value);

using ForestOptionRow =
    RowOver<ForestOptions, bool, int, ByteCount, Merge, ControlScope, std::optional<int>,
            std::optional<TileRange>, std::optional<std::filesystem::path>>;

/// The options of a forest beside those of its trees' shape.
LEAFHULL_API std::span<const ForestOptionRow> forest_table();

/// A forest that can be computed and kept: plan_forest() has checked it.
class ForestPlan {
 public:
  /// The options; `single` is relative to the folder.
  const ForestOptions& options() const { return options_; }
  const OutputFolder& folder() const { return folder_; }
  const std::optional<OutputFile>& single() const { return single_; }

  /// A .json file for the report, which may lie in the folder before that is made.
  /// @param file relative to the working folder.
  /// @throws Error usage: it has the name of one of the forest's own files, or as OutputFile.
  LEAFHULL_API OutputFile report_file(const std::filesystem::path& file) const;

 private:
  friend ForestPlan plan_forest(ForestOptions options, const std::filesystem::path& folder,
                                const std::filesystem::path& scene);
  ForestPlan(ForestOptions options, OutputFolder folder, std::filesystem::path scene);

  ForestOptions options_;
  OutputFolder folder_;
  std::filesystem::path scene_;
  std::optional<OutputFile> single_;
};

/// Checks the options, the shape's too, and all names before any work is done.
/// @param scene the file that the scene is read from; empty where there is none.
/// @throws Error usage: a value out of range, two options that contradict each other, a `single`
///         that is not .glb or .ply or is the scene itself, or a name of the forest's own files for
///         one of the two; output: the folder or `single` could not be made or written to.
LEAFHULL_API ForestPlan plan_forest(ForestOptions options, const std::filesystem::path& folder,
                                    const std::filesystem::path& scene = {});

/// A finished tile.
struct TileRow {
  int level = 0, x = 0, y = 0, z = 0;  ///< as in tiles/LEVEL/X_Y_Z.glb
  std::uint64_t leaf_vertices = 0;     ///< in the tile
  std::uint64_t gathered = 0;          ///< kernels that reach it
  std::uint64_t evaluated_voxels = 0, vertices = 0, triangles = 0;
  double seconds = 0;
  std::uint64_t resident_bytes = 0;  ///< of the tile's process, once it was computed
  int rank = 0;                      ///< the rank that computed it
};

/// The outcome of a level of abstraction.
struct LevelRow {
  int level = 0;
  double voxel_size = 0;  ///< h
  double threshold = 0;   ///< T; NaN where it is the scene's and no part has run
  double error = 0;       ///< how far its surface may be from that of level 0, scene units
};

/// What a run did.
struct ForestSummary {
  std::size_t trees = 0, models = 0, skipped = 0;
  std::size_t tiles = 0, resumed = 0, empty = 0;  ///< tiles in all; done before; without a surface
  std::size_t remaining = 0;                      ///< tiles that other ranges have still to do
  std::uint64_t leaf_vertices = 0;                ///< of all trees
  std::uint64_t mesh_vertices = 0, mesh_triangles = 0;
  std::uint64_t peak_memory_bytes = 0;  ///< of the largest rank
  std::vector<StageTime> seconds;
  std::vector<LevelRow> levels;
  /// All tiles done so far, by earlier runs and other ranges too; none where `was_finished`.
  std::vector<TileRow> rows;
  bool was_finished = false;  ///< by an earlier run; nothing was left to do
  std::vector<std::string> warnings;
};

/// Turns a scene into abstract shapes, kept in the plan's folder: `tileset.json` (OGC 3D Tiles 1.1)
/// and tiles/ for a canopy, forest.glb for Merge::none, and manifest.json with a checksum of each
/// file. The bytes depend on the scene and the options alone, not on ranks, ranges, threads or
/// interruptions.
/// @throws Error usage: a model that would be overwritten; a folder that holds another forest, or
///         one that is not finished, without `resume`; more memory or more tiles than there is room
///         for; input: a model; empty: no tree has a surface; output; device.
LEAFHULL_API ForestSummary run_forest(const Scene& scene, const ForestPlan& plan, Device& device,
                                      Ranks& ranks, const Progress& progress = {});

/// The report as one JSON object, schema "leafhull-forest-report/1".
LEAFHULL_API std::string forest_report_json(const ForestSummary& summary,
                                            const ForestOptions& options,
                                            const RunDescription& run);

}  // namespace leafhull
