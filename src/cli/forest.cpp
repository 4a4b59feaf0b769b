// SPDX-License-Identifier: Apache-2.0
#include "leafhull/forest.h"

#include <malloc.h>

#include <iostream>
#include <limits>
#include <string>
#include <utility>

#include "cli/context.h"
#include "cli/forest_words.h"
#include "cli/help.h"
#include "cli/values.h"
#include "cli/verb.h"
#include "leafhull/error.h"
#include "leafhull/ranks.h"

namespace leafhull::cli {
namespace {

namespace fs = std::filesystem;

std::vector<Flag> forest_output_flags() {
  static const ArgumentRow folder[] = {
      ArgumentRow("Output", "output", &Arguments::output,
                  "keeps the forest: tileset.json with its tiles, or forest.glb",
                  {.range = "made where it is missing", .value = "DIR", .letter = 'o'})};
  static const OutputOptionRow report[] = {
      OutputOptionRow("Output", "report", &OutputFiles::report,
                      "options, counts, times, memory, and a row for each tile",
                      {.range = ".json, or - for standard output"})};
  return all_of({flags_of(folder), flags_of(forest_table(), &Arguments::forest, "Output"),
                 flags_of(std::span<const OutputOptionRow>(report), &Arguments::files)});
}

/// The options of a forest's trees; those that tiles cannot have are refused with the reason.
std::vector<Flag> tree_flags() {
  constexpr std::pair<std::string_view, std::string_view> kRefused[] = {
      {"mesher", "only the mesher over bricks makes tiles meet without cracks"},
      {"adaptivity", "merged triangles would leave cracks between tiles"}};
  std::vector<Flag> flags = option_flags();
  for (Flag& flag : flags) {
    for (const auto& [option, why] : kRefused) {
      if (flag.line.name != option) continue;
      flag.hidden = true;
      flag.set = [option = option, why = why](Arguments&, const std::string&) {
        throw Error(ErrorCode::usage,
                    "--" + std::string(option) + " does not apply to forests: " + std::string(why),
                    "Leave it out.");
      };
    }
  }
  return flags;
}

ForestPlan plan_of(const Arguments& arguments) {
  if (arguments.output.empty()) {
    throw Error(ErrorCode::usage, "no folder for the forest is named", "Name one: -o out/.");
  }
  ForestOptions options = arguments.forest;
  options.shape = arguments.options;
  return plan_forest(std::move(options), arguments.output, arguments.operand);
}

/// The report's file; empty where there is none, or where it is standard output.
std::optional<OutputFile> report_file(const Arguments& arguments, const ForestPlan& plan) {
  const std::optional<fs::path>& report = arguments.files.report;
  if (!report || *report == "-") return std::nullopt;
  return plan.report_file(*report);
}

/// Checks that all ranks have the same command: if not, they would wait for each other for ever.
void check_ranks_agree(const Arguments& arguments, Ranks& ranks) {
  std::string words;
  for (std::size_t i = 1; i < arguments.command.size(); ++i) words += arguments.command[i] + '\0';
  const std::vector<std::string> all = ranks.all(words);
  for (std::size_t rank = 1; rank < all.size(); ++rank) {
    if (all[rank] == all.front()) continue;
    throw Error(
        ErrorCode::usage,
        "rank " + std::to_string(rank) + " was started with another command than rank 0",
        "Give all ranks the same command. To compute separate parts, start each without MPI "
        "(srun --mpi=none).");
  }
}

/// Refuses --tile-range on several ranks, which would all write that part's journal.
void check_ranks_share_all(const Arguments& arguments, const Ranks& ranks) {
  if (ranks.size() == 1 || !arguments.forest.range) return;
  throw Error(ErrorCode::usage,
              "--tile-range does not apply to ranks: the " + std::to_string(ranks.size()) +
                  " that were started share all tiles",
              "Leave it out, or start each part on its own, without mpirun.");
}

std::string how_to_go_on(const ForestOptions& forest) {
  if (forest.resume) return "the same command continues";
  return std::string("the same command with --resume") +
         (forest.restart ? " in place of --restart" : "") + " continues";
}

DeviceOptions device_of(const Arguments& arguments, const Ranks& ranks) {
  DeviceOptions device = arguments.device;
  if (device.threads == 0 && ranks.size() > 1) device.threads = ranks.cores();
  return device;
}

void warn_of_memory(const Arguments& arguments, Context& context) {
  if (!arguments.given.contains("memory") || arguments.forest.merge != Merge::none) return;
  context.warn({"--memory only bounds a canopy; --merge none takes what its models need"});
}

std::string tiles_in_words(const ForestSummary& summary) {
  std::string text = counted(summary.tiles, "tile");
  if (summary.resumed > 0) text += ", " + count(summary.resumed) + " of them from an earlier run";
  if (summary.empty > 0) text += ", " + count(summary.empty) + " without a surface";
  if (summary.remaining > 0) text += ", " + count(summary.remaining) + " still to do";
  return text;
}

void say_summary(Context& context, const ForestSummary& summary, const Arguments& arguments,
                 std::uint64_t leaf_vertices) {
  const double elapsed = context.elapsed();
  if (summary.was_finished) {
    context.console.say("leafhull: " + arguments.output.string() +
                        " holds this forest, finished; nothing was left to do");
    return;
  }
  context.say_stages(summary.seconds, "  ", 18);
  std::string text =
      "leafhull: " + counted(summary.trees, "tree") + " of " + counted(summary.models, "model");
  if (arguments.forest.merge == Merge::canopy) text += ", " + tiles_in_words(summary);
  text += ": " + count(summary.mesh_triangles) + " triangles in " + seconds(elapsed) + ", " +
          bytes(summary.peak_memory_bytes) + " at most";
  if (leaf_vertices > 0) {
    text += ", " + per_second(leaf_vertices, elapsed);
  }
  context.console.say(text + ": " + arguments.output.string());
}

void write_report(const ForestSummary& summary, const Arguments& arguments,
                  const ForestOptions& options, const std::optional<OutputFile>& file) {
  if (!arguments.files.report) return;
  const std::string report =
      forest_report_json(summary, options, {arguments.operand.string(), arguments.command});
  if (file) {
    file->write(report);
  } else {
    std::cout << report;
  }
}

/// Keeps freed memory: tiles are alike, so the next one, on any thread, reuses what the last one
/// freed without asking the system again.
void keep_freed_memory() {
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the most that glibc takes
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

/// Rethrows the error and adds how many tiles are still to do; finished tiles stay.
[[noreturn]] void rethrow_with(const std::string& still_to_do) {
  const Failure failure = current_failure();
  const auto code = static_cast<ErrorCode>(failure.exit_code);
  const bool tells_itself =
      code == ErrorCode::usage || code == ErrorCode::input || code == ErrorCode::empty;
  if (tells_itself || still_to_do.empty()) throw;
  throw Error(code, failure.what,
              failure.remedy + (failure.remedy.empty() ? "" : " ") + still_to_do);
}

void make_forest(const Arguments& arguments, Ranks& ranks) {
  keep_freed_memory();
  const bool speaks = ranks.rank() == 0;
  Context context(arguments, speaks);
  Console& console = context.console;
  check_ranks_agree(arguments, ranks);
  check_ranks_share_all(arguments, ranks);
  const ForestPlan plan = plan_of(arguments);
  const std::optional<OutputFile> report = report_file(arguments, plan);
  warn_of_memory(arguments, context);
  ForestWords words(ranks, arguments.quiet, how_to_go_on(plan.options()));

  const Options shape = resolve(arguments.options);
  const DeviceOptions shared = device_of(arguments, ranks);
  const ThreadLimit limit(shared.threads);
  context.open_device(shared, shape.falloff);
  console.progress({.stage = "read"});
  const Scene scene = read_scene(arguments.operand, shape.leaf_options(), shape.read_options());
  context.warn(scene.warnings);
  Device& device = context.device();
  console.detail("device      " + device.info().name);
  console.detail("scene       " + counted(scene.trees.size(), "tree") + " of " +
                 counted(scene.models.size(), "model"));
  if (ranks.size() > 1) {
    console.detail("ranks       " + counted(static_cast<std::uint64_t>(ranks.size()), "rank") +
                   ", this one with " +
                   counted(static_cast<std::uint64_t>(device.threads()), "thread"));
  }

  std::string stage;
  std::size_t finished = 0;
  std::uint64_t leaf_vertices = 0;
  const auto advance = [&](const Advance& now) {
    if (now.stage != stage || now.finished < finished) console.count_anew();
    stage = now.stage;
    finished = now.finished;
    leaf_vertices = now.leaf_vertices;
    if (now.stage == "tiles" && now.all > 0) words.set_tiles(now.all);
    console.progress(now);
  };
  const ForestSummary summary = [&] {
    try {
      return run_forest(scene, plan, device, ranks, advance);
    } catch (const std::exception&) {
      rethrow_with(words.still_to_do());
    }
  }();
  if (!speaks) return;
  context.warn(summary.warnings);
  write_report(summary, arguments, plan.options(), report);
  // Where the run did all, on any number of ranks, count the trees' own leaf vertices.
  const bool did_all = summary.resumed == 0 && summary.remaining == 0;
  say_summary(context, summary, arguments, did_all ? summary.leaf_vertices : leaf_vertices);
}

/// Runs the verb; of several ranks, one that fails ends the others, which would not notice.
void run_forest_verb(const Arguments& arguments) {
  const std::unique_ptr<Ranks> ranks = open_ranks();
  if (ranks->size() == 1) return make_forest(arguments, *ranks);
  try {
    make_forest(arguments, *ranks);
  } catch (const std::exception&) {
    const Failure failure = current_failure();
    if (ranks->leave()) {
      print_error("rank " + std::to_string(ranks->rank()) + ": " + failure.what, failure.remedy);
    }
    ranks->abort(failure.exit_code);
  }
}

}  // namespace

std::vector<Flag> forest_flags() {
  return all_of({flags_of(forest_table(), &Arguments::forest, "Forest"),
                 flags_of(forest_table(), &Arguments::forest, "Work"), forest_output_flags()});
}

Verb forest_verb() {
  return {
      .name = "forest",
      .summary = "thousands of trees: one canopy in tiles, or instances",
      .about =
          "Turns a SCENE of thousands of trees into abstract shapes, in bounded memory. In the\n"
          "canopy the densities of neighbouring crowns add up; its surface is computed tile by\n"
          "tile and written as OGC 3D Tiles, DIR/tileset.json. With --merge none each model is\n"
          "extracted once and placed by instances, DIR/forest.glb.\n"
          "\n"
          "A scatter file is a table (.csv) or an object per line (.jsonl): model, position,\n"
          "rotation, scale. A resolution counts along the largest tree.\n"
          "\n"
          "On many machines: mpirun leafhull forest, where leafhull is built with MPI; or, on\n"
          "farms without, --tile-range 1/N to N/N and then --finish, on one folder. The result\n"
          "has the same bytes. Finished work is never lost: --resume continues.",
      .examples =
          "  leafhull forest stand.csv -o stand/ --voxel-size 0.25\n"
          "  leafhull forest stand.csv -o stand/ --levels 4 --single stand.glb\n"
          "  leafhull forest stand.csv -o stand/ --merge none\n"
          "  mpirun -n 4 --bind-to none leafhull forest stand.csv -o stand/\n"
          "  leafhull forest stand.csv -o stand/ --tile-range 3/16\n",
      .takes_tree = true,
      .operand = "SCENE",
      .operand_help = "a scatter file, .csv or .jsonl, or a .glb or .gltf file",
      .operand_example = "stand.csv",
      .flags =
          all_of({forest_flags(), tree_flags(), device_flags(), console_flags(), help_flags()}),
      .run = run_forest_verb};
}

Verb help_forests_verb() {
  return table_verb("help-forests", "Prints the options of forests as Markdown tables.",
                    "  leafhull help-forests\n",
                    [](const Arguments&) { std::cout << markdown(forest_flags()); });
}

}  // namespace leafhull::cli
