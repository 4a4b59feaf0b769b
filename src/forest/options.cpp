// SPDX-License-Identifier: Apache-2.0
// The options of a forest: their rows, which of them contradict each other, and its plan.
#include <string>
#include <system_error>
#include <utility>

#include "density/lattice.h"
#include "forest/forest_folder.h"
#include "leafhull/error.h"
#include "leafhull/forest.h"
#include "output/write_error.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMergeNames[] = {"none", "canopy"};
constexpr std::string_view kScopeNames[] = {"model", "scene"};

constexpr int kMostLevels = 8;
constexpr int kLargestTile = 512;
constexpr int kMostParts = 1'000'000;
constexpr double kLeastMemory = 512 << 20;

[[noreturn]] void refuse(const std::string& what, const std::string& remedy) {
  throw Error(ErrorCode::usage, what, remedy);
}

/// Whether an option is given, and its flag.
using Given = std::pair<bool, std::string>;

void refuse_both(const Given& first, const Given& second, const std::string& remedy) {
  if (!first.first || !second.first) return;
  refuse(first.second + " and " + second.second + " contradict each other", remedy);
}

void check_contradictions(const ForestOptions& forest) {
  const Given resume(forest.resume, "--resume"), restart(forest.restart, "--restart"),
      finish(forest.finish, "--finish"), range(forest.range.has_value(), "--tile-range"),
      single(forest.single.has_value(), "--single"), levels(forest.levels > 1, "--levels"),
      tile(forest.tile.has_value(), "--tile"), apart(forest.merge == Merge::none, "--merge none");
  refuse_both(resume, restart, "Continue the forest in DIR, or start over.");
  refuse_both(finish, range, "Compute every part first, then finish once.");
  refuse_both(finish, restart, "--finish needs the tiles that --restart removes.");
  refuse_both(range, restart, "A part would remove what others have done: empty DIR first.");
  refuse_both(range, single, "It needs all tiles: give it to --finish.");
  for (const auto& of_tiles : {levels, single, tile, range, finish}) {
    refuse_both(apart, of_tiles, "--merge none has no tiles or levels.");
  }
}

/// Refuses options that a density over several trees cannot have.
void check_shape(const ForestOptions& forest) {
  const Options& shape = forest.shape;
  const bool over_scene = forest.control_scope == ControlScope::scene;
  if (forest.merge == Merge::none) {
    if (over_scene) {
      refuse("--control-scope scene needs trees that share a density", "Add --merge canopy.");
    }
    return;
  }
  if (over_scene && (shape.erosion || shape.dilation)) {
    refuse("--erosion and --dilation are set for each model, but --control-scope is scene",
           "Leave out one of the two.");
  }
  if (shape.density == DensitySource::grid) {
    refuse("--density grid is only for a single tree", "Leave it out, or add --merge none.");
  }
  if (shape.dense || shape.adaptivity > 0) {
    refuse("tiles allow neither --dense nor --adaptivity", "Leave them out, or add --merge none.");
  }
  if (shape.hollows == Hollows::fill) {
    refuse("a tile cannot tell whether a hollow is closed",
           "Leave out --hollows fill, or add --merge none.");
  }
}

}  // namespace

std::span<const std::string_view> names(Merge) { return kMergeNames; }
std::span<const std::string_view> names(ControlScope) { return kScopeNames; }

void describe(OptionLine& line, const TileRange&) {
  line.value = "I/N";
  line.range = "1/N to N/N";
}

void check_value(const OptionLine& line, const TileRange& range) {
  check_value(line, range.parts);
  if (range.part >= 1 && range.part <= range.parts) return;
  const std::string parts = std::to_string(range.parts);
  refuse(line.spelling + " " + std::to_string(range.part) + "/" + parts + " is out of range",
         "Ranges count from 1: give 1/" + parts + " to " + parts + "/" + parts + ".");
}

std::span<const ForestOptionRow> forest_table() {
  using Row = ForestOptionRow;
  static const Row rows[] = {
      Row("Forest", "merge", &ForestOptions::merge,
          "one surface over all trees, or each model once, placed as instances"),
      Row("Forest", "control-scope", &ForestOptions::control_scope,
          "what the mean density and its spread are taken over"),
      Row("Forest", "levels", &ForestOptions::levels, {1, kMostLevels},
          "number of levels of detail; each has voxels and R_max twice as large"),
      Row("Work", "tile", &ForestOptions::tile,
          {.low = kRootEdge, .high = kLargestTile, .step = kRootEdge}, "the edge of a tile",
          {.unit = "voxels", .default_value = "128, less if memory is short"}),
      Row("Work", "memory", &ForestOptions::memory, {kLeastMemory, kLargestNumber},
          "most memory that a rank may keep resident, for a canopy",
          {.unit = "bytes, or with K, M, G, T"}),
      Row("Work", "tile-range", &ForestOptions::range, {1, kMostParts},
          "computes part I of N, for farms without MPI; run --finish once afterwards",
          {.default_value = "all tiles"}),
      Row("Work", "finish", &ForestOptions::finish,
          "assembles the result once all tiles are computed"),
      Row("Work", "resume", &ForestOptions::resume, "continues a run that was cut off"),
      Row("Work", "restart", &ForestOptions::restart, "starts over and replaces the forest in DIR"),
      Row("Output", "single", &ForestOptions::single,
          "also writes the finest level's tiles as one welded mesh", {.range = ".glb .ply"}),
  };
  return rows;
}

ForestPlan::ForestPlan(ForestOptions options, OutputFolder folder, fs::path scene)
    : options_(std::move(options)), folder_(std::move(folder)), scene_(std::move(scene)) {
  if (!scene_.empty()) check_name(scene_, "the scene", folder_.path());
  if (!options_.single) return;
  const fs::path file = *options_.single;
  const std::string extension = lower_extension(file);
  if (extension != ".glb" && extension != ".ply") {
    refuse("--single cannot be written to " + file.string(), "Name a .glb or .ply file.");
  }
  check_name(file, "--single", folder_.path());
  single_ = folder_.file(file, extension, {scene_});
  std::error_code error;
  options_.single = fs::proximate(file, folder_.path(), error);
  if (error) throw write_error(file, error.value());
}

OutputFile ForestPlan::report_file(const fs::path& file) const {
  check_name(file, "--report", folder_.path());
  return folder_.file(file, ".json", {scene_});
}

ForestPlan plan_forest(ForestOptions options, const fs::path& folder, const fs::path& scene) {
  (void)resolve(options.shape);
  check_rows(forest_table(), options);
  check_contradictions(options);
  check_shape(options);
  return {std::move(options), OutputFolder(folder), scene};
}

}  // namespace leafhull
