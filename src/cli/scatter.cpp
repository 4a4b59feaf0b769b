// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <limits>

#include "cli/console.h"
#include "cli/signals.h"
#include "cli/values.h"
#include "cli/verb.h"
#include "leafhull/error.h"
#include "leafhull/scene.h"

namespace leafhull::cli {
namespace {

constexpr double kWidest = 1e9;

/// The two numbers on both sides of `separator`.
Vec2d pair_of(std::string_view flag, const std::string& text, char separator, const char* remedy) {
  const std::size_t at = text.find(separator);
  if (at == std::string::npos) {
    throw Error(ErrorCode::usage, std::string(flag) + " '" + text + "' is not two numbers", remedy);
  }
  return {real_number(flag, text.substr(0, at), 0, kWidest),
          real_number(flag, text.substr(at + 1), 0, kWidest)};
}

HeightMap& ground_of(Arguments& a) {
  if (!a.scatter.ground) a.scatter.ground.emplace();
  return *a.scatter.ground;
}

std::vector<Flag> scatter_flags() {
  return {
      {.spelling = "-o,--output",
       .value = "FILE",
       .group = "Output",
       .range = ".csv",
       .default_value = "none",
       .help = "the scatter file",
       .set = [](Arguments& a, const std::string& text) { a.scatter_file = text; }},
      {.spelling = "--count",
       .value = "N",
       .group = "Trees",
       .range = "[1, 1000000]",
       .default_value = "none",
       .help = "number of trees",
       .set =
           [](Arguments& a, const std::string& text) {
             a.scatter.count =
                 static_cast<std::size_t>(whole_number("--count", text, 1, 1'000'000));
           }},
      {.spelling = "--seed",
       .value = "N",
       .group = "Trees",
       .range = "[0, 2147483647]",
       .default_value = "1",
       .help = "random seed",
       .set =
           [](Arguments& a, const std::string& text) {
             a.scatter.seed = static_cast<std::uint64_t>(
                 whole_number("--seed", text, 0, std::numeric_limits<int>::max()));
           }},
      {.spelling = "--scale",
       .value = "LOW:HIGH",
       .group = "Trees",
       .range = "> 0",
       .default_value = "0.8:1.2",
       .help = "range of sizes, drawn evenly",
       .set =
           [](Arguments& a, const std::string& text) {
             const Vec2d range =
                 pair_of("--scale", text, ':', "Give LOW:HIGH, such as 0.8:1.2, or 1:1.");
             a.scatter.scale_low = range.x;
             a.scatter.scale_high = range.y;
           }},
      {.spelling = "--spacing",
       .value = "X",
       .group = "Ground",
       .unit = "crown widths",
       .range = "> 0",
       .default_value = "0.8",
       .help = "least distance between trees",
       .set =
           [](Arguments& a, const std::string& text) {
             a.given.insert("spacing");
             a.scatter.spacing = real_number("--spacing", text, 0, kWidest);
           }},
      {.spelling = "--area",
       .value = "WxD",
       .group = "Ground",
       .unit = "model units",
       .range = "> 0 each",
       .default_value = "as --spacing asks",
       .help = "sides of the rectangle along x and z, about the origin",
       .set =
           [](Arguments& a, const std::string& text) {
             a.scatter.area =
                 pair_of("--area", text, 'x', "Give its sides along x and z, such as 200x100.");
           }},
      {.spelling = "--height-map",
       .value = "FILE",
       .group = "Ground",
       .range = ".png, grey, 8 or 16 bits",
       .default_value = "flat",
       .help = "the ground as seen from above, white the highest: +x right, +z down",
       .set = [](Arguments& a, const std::string& text) { ground_of(a).picture = text; }},
      {.spelling = "--height",
       .value = "X",
       .group = "Ground",
       .unit = "model units",
       .default_value = "10",
       .help = "height of white above black in the height map",
       .set =
           [](Arguments& a, const std::string& text) {
             ground_of(a).height = real_number("--height", text, -kWidest, kWidest);
           }},
  };
}

/// Of the options about leaves only --leaves is offered: the others do not move a tree.
std::vector<Flag> input_flags() {
  std::vector<Flag> flags = option_flags("Leaves");
  std::erase_if(flags, [](const Flag& flag) { return flag.spelling != "--leaves"; });
  return all_of({option_flags("Input"), flags});
}

void check_scatter_arguments(const Arguments& arguments) {
  const ScatterOptions& options = arguments.scatter;
  if (options.count == 0) {
    throw Error(ErrorCode::usage, "--count is missing", "Give the number of trees: --count 2000.");
  }
  if (arguments.scatter_file.empty()) {
    throw Error(ErrorCode::usage, "no output is named", "Name the scatter file: -o scene.csv.");
  }
  if (options.ground && options.ground->picture.empty()) {
    throw Error(ErrorCode::usage, "--height is given without a height map",
                "Name one with --height-map.");
  }
  if (options.area && arguments.given.contains("spacing")) {
    throw Error(ErrorCode::usage, "--area and --spacing contradict each other",
                "Give one of the two.");
  }
}

void run_scatter(const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  Console console(arguments.quiet, arguments.verbose);
  check_scatter_arguments(arguments);
  ScatterOptions options = arguments.scatter;
  options.trees = arguments.trees;
  options.leaves = resolve(arguments.options).leaf_options();
  options.reading = arguments.options.read_options();
  catch_signals();
  console.progress("scatter", 0);
  write_scatter(options, arguments.scatter_file);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  console.say("leafhull: " + count(options.count) + (options.count == 1 ? " tree" : " trees") +
              " of " + count(options.trees.size()) +
              (options.trees.size() == 1 ? " model" : " models") + " in " +
              seconds(elapsed.count()) + ": " + arguments.scatter_file.string());
}

}  // namespace

Verb scatter_verb() {
  return {.name = "scatter",
          .summary = "a forest of some trees: who stands where, for leafhull forest",
          .about =
              "Places copies of the TREEs at random, none too near to another (a Poisson-disk\n"
              "pattern), turned about y and scaled, over a rectangle that may have hills. The\n"
              "result is a scatter file: a line for each tree, for leafhull forest to read.\n"
              "The same command gives the same file.",
          .examples =
              "  leafhull scatter birch.glb ash.glb --count 2000 --seed 7 -o scene.csv\n"
              "  leafhull scatter birch.glb --count 500 --area 300x80 -o avenue.csv\n"
              "  leafhull scatter birch.glb --count 20000 --height-map hills.png --height 60 "
              "-o hills.csv\n",
          .takes_trees = true,
          .operand = "TREE...",
          .operand_help = "one or more .glb, .gltf, .fbx or .obj files, each equally often",
          .flags = all_of({scatter_flags(), input_flags(), console_flags(), help_flags()}),
          .run = run_scatter};
}

}  // namespace leafhull::cli
