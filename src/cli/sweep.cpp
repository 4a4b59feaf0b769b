// SPDX-License-Identifier: Apache-2.0
#include "leafhull/sweep.h"

#include <utility>

#include "cli/context.h"
#include "cli/signals.h"
#include "cli/values.h"
#include "cli/verb.h"
#include "leafhull/error.h"
#include "leafhull/tree.h"

namespace leafhull::cli {
namespace {

constexpr std::size_t kMostUnasked = 10'000;

/// The options; those that can be swept take several values.
std::vector<Flag> swept_flags() {
  std::vector<Flag> flags = option_flags();
  for (Flag& flag : flags) {
    const OptionRow& row = option_row(flag.line.name);
    if (!can_sweep(row)) continue;
    flag.set = [&row](Arguments& arguments, const std::string& text) {
      const SweptOption option = swept_option(row, text);
      if (option.values.size() == 1 && option.values.front() == text) {
        set_option(arguments.options, row, text);
      } else {
        arguments.swept.push_back(option);
      }
      arguments.given.insert(row.name);
    };
  }
  return flags;
}

std::vector<Flag> sweep_flags() {
  static const ArgumentRow rows[] = {
      ArgumentRow("Output", "output", &Arguments::output,
                  "keeps the sweep: tables, plots, pictures and what is done",
                  {.range = "made where it is missing", .value = "FOLDER", .letter = 'o'}),
      ArgumentRow("Output", "restart", &Arguments::restart,
                  "starts over and replaces the sweep in the folder"),
      ArgumentRow("Output", "yes", &Arguments::yes, "allows more than 10,000 combinations"),
  };
  return flags_of(rows);
}

void check_sweep_arguments(const Arguments& arguments) {
  const std::string example = "such as leafhull sweep " + quoted(arguments.operand.string()) +
                              " --threshold 1.5:2.5:0.25 -o ";
  if (arguments.swept.empty()) {
    (void)resolve(arguments.options);
    throw Error(ErrorCode::usage, "no option is swept",
                "Give one a range or a list, " + example +
                    (arguments.output.empty() ? "out" : quoted(arguments.output)) + ".");
  }
  if (arguments.output.empty()) {
    throw Error(ErrorCode::usage, "no folder is named",
                "Name the one that keeps the sweep, " + example + "out.");
  }
  for (const OptionRow& row : option_table()) {
    if (arguments.given.contains(row.name) && arguments.given.contains(row.percent)) {
      throw Error(ErrorCode::usage,
                  "--" + std::string(row.name) + " and --" + std::string(row.percent) +
                      " contradict each other",
                  "Give one of the two.");
    }
  }
}

SweepPlan plan_of(const Arguments& arguments) {
  const std::size_t all = combination_count(arguments.swept);
  if (all > kMostUnasked && !arguments.yes) {
    throw Error(ErrorCode::usage, "these are " + count(all) + " combinations",
                "Take larger steps, or agree with --yes.");
  }
  return plan_sweep(arguments.options, arguments.swept);
}

/// The first combination's falloff, whose kernels are built while the tree is read.
int first_falloff(const SweepPlan& plan) { return plan.combinations().front().falloff; }

void say_summary(Context& context, const SweepSummary& summary, const Arguments& arguments) {
  std::string text = "leafhull: " + counted(summary.combinations, "combination");
  if (summary.resumed > 0) text += ", " + count(summary.resumed) + " of them from an earlier run";
  if (summary.empty > 0) text += ", " + count(summary.empty) + " without a surface";
  if (summary.failed > 0) text += ", " + count(summary.failed) + " that failed (see sweep.csv)";
  context.console.say(text + " in " + seconds(context.elapsed()) + ": " +
                      arguments.output.string());
  context.say_stages(summary.seconds, "  ", 18);
}

void run_sweep_verb(const Arguments& arguments) {
  Context context(arguments);
  check_sweep_arguments(arguments);
  const SweepPlan plan = plan_of(arguments);
  const OutputFolder folder(arguments.output);
  catch_signals();

  context.open_device(first_falloff(plan));
  const LeafSet leaves = context.read_leaves(plan.combinations().front().leaf_options());
  Device& device = context.device();
  Console& console = context.console;
  console.detail("device      " + device.info().name);
  console.detail("leaves      " + count(leaves.leaf_count) + " with " +
                 count(leaves.vertices.size()) + " vertices");
  catch_signals(arguments.quiet
                    ? ""
                    : "leafhull: stopped; what is done is in " + folder.path().string() +
                          ": the same command" + (arguments.restart ? " without --restart" : "") +
                          " continues from there\n");

  bool begun = false;
  const SweepSummary summary =
      run_sweep(leaves, plan, device, {folder, arguments.restart},
                {arguments.operand.string(), arguments.command}, [&](const Advance& now) {
                  if (!std::exchange(begun, true) && now.finished > 0) {
                    console.say("leafhull: resuming: " + count(now.finished) + " of " +
                                count(now.all) + " done");
                  }
                  console.progress(now);
                });
  context.warn(summary.warnings);
  say_summary(context, summary, arguments);
}

}  // namespace

Verb sweep_verb() {
  return {
      .name = "sweep",
      .summary = "every combination of several values, as tables, plots and pictures",
      .about =
          "Extracts TREE with every combination of several values of options, and keeps in a\n"
          "folder: sweep.csv and sweep.json with a row for each, a plot for each swept number,\n"
          "and contact-sheet.png with their pictures, which are also in pictures/.\n"
          "\n"
          "In Shape and Resolution, a number may be a range first:last:step, both ends\n"
          "included, or a list a,b,c; a NAME may be a list. Write each percentage with its %:\n"
          "--threshold 30%:60%:10%. The options are combined in the order below, the first\n"
          "changing slowest. A row's seconds are what it took beyond the rows before it.\n"
          "\n"
          "Ctrl-C loses no finished combination: the same command continues where it stopped.",
      .examples =
          "  leafhull sweep birch.glb --threshold 1.5:2.5:0.25 -o out\n"
          "  leafhull sweep birch.glb --coverage 0.8:0.98:0.06 --radius-max 1.5,2.5,4 -o out\n"
          "  leafhull sweep birch.glb --method isotropic,controlled --threshold 30%:60%:10% "
          "-o out\n",
      .takes_tree = true,
      .flags =
          all_of({swept_flags(), sweep_flags(), device_flags(), console_flags(), help_flags()}),
      .run = run_sweep_verb};
}

}  // namespace leafhull::cli
