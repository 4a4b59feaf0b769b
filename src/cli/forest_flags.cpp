// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>
#include <utility>

#include "cli/flags.h"
#include "cli/values.h"
#include "leafhull/error.h"

namespace leafhull::cli {
namespace {

constexpr std::uint64_t kLeastMemory = std::uint64_t{512} << 20;
constexpr int kMostLevels = 8;
constexpr int kTileStep = 32, kLargestTile = 512;
constexpr int kMostParts = 1'000'000;

void set_tile(Arguments& a, const std::string& text) {
  const int edge = whole_number("--tile", text, kTileStep, kLargestTile);
  if (edge % kTileStep != 0) {
    throw Error(ErrorCode::usage, "--tile " + text + " is no multiple of 32",
                "Give " + std::to_string(edge - edge % kTileStep) + " or " +
                    std::to_string(edge - edge % kTileStep + kTileStep) + ".");
  }
  a.forest.tile = edge;
}

void set_range(Arguments& a, const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) {
    throw Error(ErrorCode::usage, "--tile-range '" + text + "' is not I/N",
                "Give the part and how many there are, such as 1/4.");
  }
  TileRange range;
  range.parts = whole_number("--tile-range, N", text.substr(slash + 1), 1, kMostParts);
  const std::string part = text.substr(0, slash);
  if (part == "0") {
    throw Error(ErrorCode::usage, "--tile-range " + text + " begins at 0",
                "Ranges count from 1: give 1/" + std::to_string(range.parts) + " to " +
                    std::to_string(range.parts) + "/" + std::to_string(range.parts) + ".");
  }
  range.part = whole_number("--tile-range, I", part, 1, range.parts);
  a.forest.range = range;
}

std::vector<Flag> merge_flags() {
  return {
      {.spelling = "--merge",
       .value = "NAME",
       .group = "Forest",
       .range = "none, canopy",
       .default_value = "canopy",
       .help = "one surface over all trees, or each model once, placed as instances",
       .set = [](Arguments& a,
                 const std::string& text) { a.forest.merge = chosen<Merge>("--merge", text); }},
      {.spelling = "--control-scope",
       .value = "NAME",
       .group = "Forest",
       .range = "model, scene",
       .default_value = "model",
       .help = "what the mean density and its spread are taken over",
       .set =
           [](Arguments& a, const std::string& text) {
             a.forest.control_scope = chosen<ControlScope>("--control-scope", text);
           }},
      {.spelling = "--levels",
       .value = "N",
       .group = "Forest",
       .range = "[1, 8]",
       .default_value = "1",
       .help = "number of levels of detail; each has voxels and R_max twice as large",
       .set =
           [](Arguments& a, const std::string& text) {
             a.forest.levels = whole_number("--levels", text, 1, kMostLevels);
           }},
  };
}

std::vector<Flag> work_flags() {
  return {
      {.spelling = "--memory",
       .value = "SIZE",
       .group = "Work",
       .unit = "bytes, or with K, M, G, T",
       .range = ">= 512M",
       .default_value = "4G",
       .help = "most memory that a rank may keep resident, for a canopy",
       .set =
           [](Arguments& a, const std::string& text) {
             a.given.insert("memory");
             a.forest.memory = byte_count("--memory", text, kLeastMemory);
           }},
      {.spelling = "--tile",
       .value = "N",
       .group = "Work",
       .unit = "voxels",
       .range = "32 to 512, a multiple of 32",
       .default_value = "128, less in little memory",
       .help = "the edge of a tile",
       .set = set_tile},
      {.spelling = "--tile-range",
       .value = "I/N",
       .group = "Work",
       .range = "1/N to N/N",
       .default_value = "all tiles",
       .help = "computes part I of N, for farms without MPI; run --finish once afterwards",
       .set = set_range},
      {.spelling = "--finish",
       .group = "Work",
       .default_value = "off",
       .help = "assembles the result once all tiles are computed",
       .set = [](Arguments& a, const std::string&) { a.forest.finish = true; }},
      {.spelling = "--resume",
       .group = "Work",
       .default_value = "off",
       .help = "continues a run that was cut off",
       .set = [](Arguments& a, const std::string&) { a.forest.resume = true; }},
      {.spelling = "--restart",
       .group = "Work",
       .default_value = "off",
       .help = "starts over and replaces the forest in DIR",
       .set = [](Arguments& a, const std::string&) { a.forest.restart = true; }},
  };
}

std::vector<Flag> forest_output_flags() {
  return {
      {.spelling = "-o,--output",
       .value = "DIR",
       .group = "Output",
       .range = "made where it is missing",
       .default_value = "none",
       .help = "keeps the forest: tileset.json with its tiles, or forest.glb",
       .set = [](Arguments& a, const std::string& text) { a.folder = text; }},
      {.spelling = "--single",
       .value = "FILE",
       .group = "Output",
       .range = ".glb .ply",
       .default_value = "none",
       .help = "also writes the finest level's tiles as one welded mesh",
       .set = [](Arguments& a, const std::string& text) { a.forest.single = text; }},
      {.spelling = "--report",
       .value = "FILE",
       .group = "Output",
       .range = ".json, or - for standard output",
       .default_value = "none",
       .help = "options, counts, times, memory, and a row for each tile",
       .set = [](Arguments& a, const std::string& text) { a.files.report = text; }},
  };
}

}  // namespace

std::vector<Flag> forest_flags() {
  return all_of({merge_flags(), work_flags(), forest_output_flags()});
}

std::vector<Flag> tree_flags() {
  constexpr std::pair<std::string_view, std::string_view> kRefused[] = {
      {"--mesher", "tiles meet without cracks by the mesher over bricks alone"},
      {"--adaptivity", "merged triangles would leave cracks between tiles"}};
  std::vector<Flag> flags = option_flags();
  for (Flag& flag : flags) {
    for (const auto& [option, why] : kRefused) {
      if (flag.spelling != option) continue;
      flag.hidden = true;
      flag.set = [option = option, why = why](Arguments&, const std::string&) {
        throw Error(ErrorCode::usage,
                    std::string(option) + " is not for forests: " + std::string(why),
                    "Leave it out.");
      };
    }
  }
  return flags;
}

}  // namespace leafhull::cli
