// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>

#include "forest/tile_record.h"
#include "leafhull/forest.h"
#include "leafhull/version.h"
#include "output/report.h"
#include "tiles/level.h"

namespace leafhull {

static nlohmann::ordered_json to_json_value(const TileRange& range) {
  return {range.part, range.parts};
}

namespace {

using Json = nlohmann::ordered_json;

/// Options that no tile uses, and options that only concern one run.
constexpr std::string_view kNotToldOf[] = {"mesher", "adaptivity", "resume", "restart"};

Json options_of(const ForestOptions& options) {
  Json object = options_object(resolved_shape(options));
  object.update(rows_object(forest_table(), options));
  for (const std::string_view key : kNotToldOf) object.erase(std::string(key));
  return object;
}

Json rows(const std::vector<TileRow>& tiles) {
  Json array = Json::array();
  for (const TileRow& tile : tiles) array.push_back(json_of(tile));
  return array;
}

Json levels(const std::vector<LevelRow>& levels) {
  Json array = Json::array();
  for (const LevelRow& level : levels) {
    array.push_back({{"level", level.level},
                     {"voxel_size", level.voxel_size},
                     {"threshold", level.threshold},
                     {"error", level.error}});
  }
  return array;
}

}  // namespace

std::string forest_report_json(const ForestSummary& summary, const ForestOptions& options,
                               const RunDescription& run) {
  const Json scene = {
      {"trees", summary.trees}, {"models", summary.models}, {"skipped", summary.skipped}};
  const Json counts = {{"leaf_vertices", summary.leaf_vertices},
                       {"tiles", summary.tiles},
                       {"empty", summary.empty},
                       {"mesh_vertices", summary.mesh_vertices},
                       {"mesh_triangles", summary.mesh_triangles}};
  const Json report = {{"schema", "leafhull-forest-report/1"},
                       {"version", kVersion},
                       {"input", run.input},
                       {"command", run.command},
                       {"options", options_of(options)},
                       {"scene", scene},
                       {"counts", counts},
                       {"levels", levels(summary.levels)},
                       {"resumed", summary.resumed},
                       {"remaining", summary.remaining},
                       {"seconds", seconds_object(summary.seconds)},
                       {"peak_memory_bytes", summary.peak_memory_bytes},
                       {"tiles", rows(summary.rows)},
                       {"warnings", summary.warnings}};
  // A path may hold bytes that are not UTF-8; JSON may not.
  return dumped(report, 2) + "\n";
}

}  // namespace leafhull
