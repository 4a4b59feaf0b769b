// SPDX-License-Identifier: Apache-2.0
#include "cli/context.h"
#include "cli/signals.h"
#include "cli/values.h"
#include "cli/verb.h"
#include "leafhull/error.h"
#include "leafhull/scene.h"

namespace leafhull::cli {
namespace {

std::vector<Flag> scatter_flags() {
  static const ArgumentRow rows[] = {ArgumentRow("Output", "output", &Arguments::output,
                                                 "the scatter file",
                                                 {.range = ".csv", .letter = 'o'})};
  return all_of({flags_of(rows), flags_of(scatter_table(), &Arguments::scatter)});
}

/// The options of the input and, about leaves, only --leaves: the others do not move a tree.
std::vector<Flag> input_flags() {
  std::vector<Flag> flags = option_flags("Leaves");
  std::erase_if(flags, [](const Flag& flag) { return flag.line.name != "leaves"; });
  return all_of({option_flags("Input"), flags});
}

void check_scatter_arguments(const Arguments& arguments) {
  const ScatterOptions& options = arguments.scatter;
  if (options.count == 0) {
    throw Error(ErrorCode::usage, "--count is missing", "Give the number of trees: --count 2000.");
  }
  if (arguments.output.empty()) {
    throw Error(ErrorCode::usage, "no output is named", "Name the scatter file: -o scene.csv.");
  }
  if (options.area && arguments.given.contains("spacing")) {
    throw Error(ErrorCode::usage, "--area and --spacing contradict each other",
                "Give one of the two.");
  }
}

void run_scatter(const Arguments& arguments) {
  Context context(arguments);
  check_scatter_arguments(arguments);
  ScatterOptions options = arguments.scatter;
  options.trees = arguments.trees;
  options.leaves = resolve(arguments.options).leaf_options();
  options.reading = arguments.options.read_options();
  catch_signals();
  context.console.progress("scatter", 0);
  write_scatter(options, arguments.output);
  context.console.say("leafhull: " + counted(options.count, "tree") + " of " +
                      counted(options.trees.size(), "model") + " in " + seconds(context.elapsed()) +
                      ": " + arguments.output.string());
}

}  // namespace

Verb scatter_verb() {
  return {.name = "scatter",
          .summary = "a scatter file for leafhull forest: trees placed at random",
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
