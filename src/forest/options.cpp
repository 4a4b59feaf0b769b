// SPDX-License-Identifier: Apache-2.0
// The options of a forest: their rows, and which of them contradict each other.
#include <string>
#include <utility>

#include "density/lattice.h"
#include "leafhull/error.h"
#include "leafhull/forest.h"

namespace leafhull {
namespace {

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

void check_forest(const ForestOptions& options) {
  (void)resolve(options.shape);
  check_rows(forest_table(), options);
  check_contradictions(options);
  check_shape(options);
}

}  // namespace leafhull
