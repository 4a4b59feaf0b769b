// SPDX-License-Identifier: Apache-2.0
#include "leafhull/study.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <thread>

#include "cli/context.h"
#include "cli/signals.h"
#include "cli/table.h"
#include "cli/values.h"
#include "cli/verb.h"
#include "leafhull/error.h"
#include "leafhull/output.h"
#include "leafhull/tree.h"
#include "leafhull/version.h"

namespace leafhull::cli {
namespace {

namespace fs = std::filesystem;

std::vector<Flag> study_output_flags() {
  static const ArgumentRow rows[] = {
      ArgumentRow("Output", "output", &Arguments::output,
                  "where report.html and study.json go; made where it is missing",
                  {.value = "FOLDER", .letter = 'o'})};
  return flags_of(rows);
}

void check_study_arguments(const Arguments& arguments) {
  if (arguments.output.empty()) {
    throw Error(ErrorCode::usage, "no folder for the report is given", "Give one: -o study/.");
  }
  const std::vector<fs::path>& trees = arguments.trees;
  for (auto tree = trees.begin(); tree != trees.end(); ++tree) {
    std::error_code missing;  // reported when the tree is read
    const auto is_same = [&](const fs::path& other) {
      return fs::equivalent(*tree, other, missing);
    };
    if (std::any_of(trees.begin(), tree, is_same)) {
      throw Error(ErrorCode::usage, tree->string() + " is given twice", "Give each tree once.");
    }
  }
  check_output_folder(arguments.output);
}

/// Names for the trees in the report: their files' stems, numbered where two are the same.
std::vector<std::string> names_of(const std::vector<fs::path>& trees) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const fs::path& tree : trees) {
    const std::string stem = tree.stem().string();
    std::string name = stem;
    for (int n = 2; !taken.insert(name).second; ++n) name = stem + " (" + std::to_string(n) + ")";
    names.push_back(name);
  }
  return names;
}

/// The command as typed, but with file names in place of paths, so that the report does not show
/// where this machine keeps its files.
std::string without_folders(const Arguments& arguments) {
  std::vector<fs::path> paths = arguments.trees;
  paths.push_back(arguments.output);
  std::string command = "leafhull";
  for (std::string word : std::span(arguments.command).subspan(1)) {
    for (const fs::path& path : paths) {
      if (!word.ends_with(path.string())) continue;
      const fs::path named = path.has_filename() ? path : path.parent_path();
      word.resize(word.size() - path.string().size());
      word += named.filename().string();
      break;
    }
    command += ' ' + cli::quoted(word);
  }
  return command;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm date{};
  localtime_r(&now, &date);
  char text[] = "YYYY-MM-DD";
  std::strftime(text, sizeof text, "%F", &date);
  return text;
}

/// The processor's name and the threads in use.
std::string machine(int threads) {
  std::string name = "unknown CPU";
  std::ifstream facts("/proc/cpuinfo");
  for (std::string line; std::getline(facts, line);) {
    if (line.starts_with("model name")) {
      name = line.substr(std::min(line.find(':') + 2, line.size()));
      break;
    }
  }
  const auto used =
      threads > 0 ? static_cast<unsigned>(threads) : std::thread::hardware_concurrency();
  return name + ", " + std::to_string(used) + (used == 1 ? " thread" : " threads");
}

LeafSet leaves_of(const fs::path& file, const Options& options, Context& context) {
  const TreeModel tree = context.read(file, "read " + file.filename().string());
  return context.find_leaves(tree, options.leaf_options());
}

/// Prints the verdicts under the project's own reading, and under how many each claim holds.
void print_verdicts(const TreeStudy& tree) {
  std::vector<std::vector<std::string>> rows = {{"claim", "own reading", "holds in"}};
  const std::vector<ReadingStudy>& readings = tree.readings;
  for (std::size_t i = 0; i < readings.front().verdicts.size(); ++i) {
    const Verdict& verdict = readings.front().verdicts[i];
    const auto holding = std::count_if(readings.begin(), readings.end(), [&](const auto& study) {
      return study.verdicts[i].outcome == Outcome::holds;
    });
    std::string number = verdict.number;
    number.resize(4, ' ');
    rows.push_back({number + verdict.claim, std::string(in_words(verdict.outcome)),
                    std::to_string(holding) + " of " + std::to_string(readings.size())});
  }
  std::cout << tree.name << ": " << count(tree.leaf_vertices) << " leaf vertices\n"
            << table(rows) << '\n';
}

void run_study(const Arguments& arguments) {
  Context context(arguments);
  check_study_arguments(arguments);
  const Options options = resolve(arguments.options);
  catch_signals(arguments.quiet ? "" : "leafhull: stopped; a study is written at its end\n");
  context.open_device(readings().front().falloff);
  std::vector<LeafSet> trees;
  for (const fs::path& tree : arguments.trees) {
    trees.push_back(leaves_of(tree, options, context));
  }
  Device& device = context.device();

  Study study;
  const std::vector<std::string> names = names_of(arguments.trees);
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const std::string tree =
        "tree " + std::to_string(i + 1) + " of " + std::to_string(trees.size()) + ": ";
    const auto progress = [&](std::string_view stage, double done) {
      context.console.progress_of_all(
          tree + std::string(stage),
          (static_cast<double>(i) + done) / static_cast<double>(trees.size()));
    };
    study.trees.push_back(study_tree(trees[i], names[i], device, progress));
  }
  study.version = kVersion;
  study.device = device.info().name + " (" + device.info().platform + ")";
  study.machine = machine(device.threads());
  study.date = today();
  study.command = without_folders(arguments);
  study.seconds = context.elapsed();
  context.console.progress("write", 0);
  write_study(study, arguments.output);
  clear_progress();
  for (const TreeStudy& tree : study.trees) print_verdicts(tree);
  context.console.say("leafhull: " + (arguments.output / "report.html").string() + " in " +
                      seconds(study.seconds));
}

}  // namespace

Verb study_verb() {
  return {
      .name = "study",
      .summary = "the paper's evaluation of your trees: does each claim hold?",
      .about =
          "Repeats the paper's tables and figures on each TREE under every reading of its open\n"
          "points, says which of its claims hold, and writes a report with pictures.",
      .examples =
          "  leafhull study birch.glb -o study/\n"
          "  leafhull study birch.glb ash.glb --leaves '*leaf*' -o study/\n",
      .takes_trees = true,
      .operand = "TREE...",
      .flags = all_of({option_flags("Input"), option_flags("Leaves"), study_output_flags(),
                       device_flags(), console_flags(), help_flags()}),
      .run = run_study};
}

}  // namespace leafhull::cli
