// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <span>

#include "cli/context.h"
#include "cli/signals.h"
#include "cli/values.h"
#include "cli/verb.h"
#include "leafhull/error.h"
#include "leafhull/shape.h"
#include "leafhull/tree.h"

namespace leafhull::cli {
namespace {

std::vector<std::filesystem::path> named(const OutputFiles& files) {
  std::vector<std::filesystem::path> all = files.shapes;
  for (const auto& file : {files.kernels, files.field, files.report}) {
    if (file) all.push_back(*file);
  }
  return all;
}

void check_extract_arguments(const Arguments& arguments) {
  if (named(arguments.files).empty()) {
    throw Error(ErrorCode::usage, "no output is named",
                "Name one, such as -o shape.glb (or --save-kernels, --save-field, --report).");
  }
}

/// Options that were typed but change nothing.
std::vector<std::string> without_effect(const Arguments& arguments, const Options& resolved) {
  std::vector<std::string> warnings;
  const auto warn = [&](std::string_view option, const std::string& why) {
    if (arguments.given.contains(option)) {
      warnings.push_back("--" + std::string(option) + " has no effect " + why);
    }
  };
  const std::string method = "with --method " + std::string(name(*resolved.method));
  if (*resolved.method == Method::isotropic) warn("flatness", method);
  if (*resolved.method != Method::controlled) {
    for (const auto option :
         {"band-low", "band-low-percent", "band-high", "band-high-percent", "spread"}) {
      warn(option, method);
    }
  }
  if (resolved.dilation) warn("radius-unit", "with --dilation, which finds R_max in crown units");
  if (!resolved.dilation && arguments.given.contains("radius-unit") &&
      !arguments.given.contains("radius-max")) {
    warnings.push_back("--radius-unit " + std::string(name(resolved.radius_unit)) +
                       " without --radius-max: the style's " + number(*resolved.radius_max) +
                       " counts in that unit");
  }
  return warnings;
}

void say_summary(Console& console, const Shape& shape, const OutputFiles& files, double elapsed) {
  const Report& report = shape.report;
  const std::string where = joined(named(files), ", ", [](const auto& file) {
    return file == "-" ? "standard output" : file.string();
  });
  console.say("leafhull: " + count(report.counts.mesh_vertices) + " vertices, " +
              count(report.counts.mesh_triangles) + " triangles, " +
              counted(report.counts.components, "component") +
              " at T = " + number(report.threshold, 4) + " in " + seconds(elapsed) + ": " + where);
}

/// Kernels are written with N_iso, which a shape alone may not need.
Detail detail_of(const OutputFiles& files) {
  return files.report || files.kernels ? Detail::report : Detail::shape;
}

void say_details(Console& console, const Report& report) {
  const Counts& counts = report.counts;
  console.detail("device      " + report.device);
  console.detail("leaves      " + count(counts.leaves) + " with " + count(counts.leaf_vertices) +
                 " vertices, " + count(counts.dropped_leaves) + " dropped, " +
                 count(counts.split_components) + " components split");
  console.detail("lattice     " + count(static_cast<std::uint64_t>(report.resolution)) +
                 " voxels along the longest side, each " + number(report.voxel_size, 4) +
                 " model units; R_max " + number(report.radius_max_model, 4));
  console.detail("evaluated   " + count(counts.evaluated_voxels) + " voxels, " +
                 count(counts.evaluated_pairs) + " pairs");
  console.detail("memory      " + count(report.peak_memory_bytes >> 20) + " MiB at most");
}

/// The total, and under it every stage with its share.
void say_times(Console& console, const std::vector<StageTime>& times) {
  const double total = times.back().seconds;
  std::size_t width = 0;
  for (const StageTime& time : times) width = std::max(width, time.stage.size());
  console.detail("total       " + seconds(total));
  for (const StageTime& time : std::span(times).first(times.size() - 1)) {
    std::string stage = time.stage;
    stage.resize(width, ' ');
    const long percent = std::lround(100 * time.seconds / total);
    console.detail("  " + stage + "  " + seconds(time.seconds) + "  " + std::to_string(percent) +
                   "%");
  }
}

void run_extract(const Arguments& arguments) {
  Context context(arguments);
  check_extract_arguments(arguments);
  const Options options = resolve(arguments.options);
  const OutputPlan plan = plan_outputs(arguments.files, arguments.operand);
  context.warn(without_effect(arguments, options));
  catch_signals();

  context.open_device(options.falloff);
  const LeafSet leaves = context.read_leaves(options.leaf_options());
  Shape shape =
      extract(leaves, options, context.device(), context.progress(), detail_of(arguments.files));
  Report& report = shape.report;
  context.warn(report.warnings);
  context.warn(rounding_warnings(plan, shape));
  report.warnings = context.warnings();
  context.add_times(report.seconds);
  report.seconds = context.times();
  report.peak_memory_bytes = peak_memory_bytes();
  context.timed("write", [&] {
    write_outputs(plan, shape, {arguments.operand.string(), arguments.command});
    return true;
  });

  say_details(context.console, report);
  say_times(context.console, context.times());
  context.console.say(leaves.choice->told);
  say_summary(context.console, shape, arguments.files, context.elapsed());
}

}  // namespace

Verb extract_verb() {
  return {.name = "extract",
          .summary = "the abstract shape of a tree: the main job",
          .about = "Turns the leaves of TREE into one closed surface, their abstract shape.",
          .examples =
              "  leafhull extract birch.glb -o shape.glb\n"
              "  leafhull extract birch.glb -o shape.glb --preset fine --radius-max 3\n"
              "  leafhull extract birch.glb -o thin.glb --style thin --threshold 40%\n"
              "  leafhull extract birch.glb --leaves '*twig*' -o shape.ply --report shape.json\n",
          .takes_tree = true,
          .flags = all_of({option_flags(), flags_of(output_table(), &Arguments::files),
                           device_flags(), console_flags(), help_flags()}),
          .run = run_extract};
}

}  // namespace leafhull::cli
