// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <iostream>
#include <nlohmann/json.hpp>

#include "cli/context.h"
#include "cli/signals.h"
#include "cli/table.h"
#include "cli/values.h"
#include "cli/verb.h"
#include "leafhull/error.h"
#include "leafhull/sweep.h"
#include "leafhull/tree.h"

namespace leafhull::cli {
namespace {

std::string command_for(const Arguments& arguments, const Suggestion& choice) {
  return "leafhull extract " + quoted(arguments.operand.string()) + arguments.typed +
         " --erosion " + number(choice.erosion) + " --dilation " + number(choice.dilation) +
         " -o " + quoted(arguments.operand.stem().string() + "-shape.glb");
}

std::string volume(double value) {
  return value < 1000 ? number(value, 4) : count(static_cast<std::uint64_t>(std::llround(value)));
}

std::string percent(std::optional<double> fraction) {
  return fraction ? number(100 * *fraction, 3) + "%" : "-";
}

void print_table(const Arguments& arguments, const std::vector<Suggestion>& choices) {
  std::vector<std::vector<std::string>> rows = {
      {"erosion", "dilation", "R_max", "T", "dilated volume", "of the box", "components"}};
  for (const Suggestion& choice : choices) {
    const Report& report = choice.report;
    const bool had = choice.failure.empty();
    rows.push_back(
        {percent(choice.erosion), percent(choice.dilation),
         had ? number(*report.options.radius_max, 3) : "-", had ? number(report.threshold, 4) : "-",
         had ? volume(choice.dilated_volume) : "-", had ? percent(choice.dilated_share) : "-",
         !had           ? "out of reach"
         : choice.empty ? "no surface"
                        : count(report.counts.components)});
  }
  std::cout << table(rows)
            << "\n"
               "erosion         how much of the leaf area is left outside: more is thinner\n"
               "dilation        how much of the shape, in 64 voxels along it, holds no leaf: more\n"
               "                is rounder\n"
               "R_max           the radius that this needs, in crown units, 1/64 of the crown\n"
               "dilated volume  what the shape fills beyond the leaves, model units cubed, and as\n"
               "                a share of the leaves' bounding box\n"
               "\nTry\n";
  for (const Suggestion& choice : choices) {
    std::cout << "  " << command_for(arguments, choice) << '\n';
  }
}

void print_json(const Arguments& arguments, const std::vector<Suggestion>& choices,
                const std::filesystem::path& picture) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const Suggestion& choice : choices) {
    const bool had = choice.failure.empty();
    list.push_back(
        {{"erosion", choice.erosion},
         {"dilation", choice.dilation},
         {"failure", had ? Json() : Json(choice.failure)},
         {"radius_max", had ? Json(*choice.report.options.radius_max) : Json()},
         {"threshold", had ? Json(choice.report.threshold) : Json()},
         {"empty", choice.empty},
         {"erosion_reached", choice.report.metrics.erosion},
         {"dilation_reached", choice.report.metrics.dilation},
         {"dilated_voxels", choice.report.metrics.dilated_voxels},
         {"dilated_volume", choice.dilated_volume},
         {"dilated_share_of_box", choice.dilated_share ? Json(*choice.dilated_share) : Json()},
         {"components", choice.report.counts.components},
         {"command", command_for(arguments, choice)}});
  }
  const Json page = {
      {"input", arguments.operand.string()}, {"picture", picture.string()}, {"suggestions", list}};
  std::cout << page.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void run_suggest(const Arguments& arguments) {
  Context context(arguments);
  const Options options = arguments.options;
  const LeafOptions leaf_options = resolve(options).leaf_options();
  std::filesystem::path picture = arguments.output;
  if (picture.empty()) picture = arguments.operand.stem().string() + "-suggest.png";
  check_output(picture, ".png", arguments.operand);
  catch_signals();

  context.open_device(options.falloff);
  const LeafSet leaves = context.read_leaves(leaf_options);
  const Suggestions suggestions = suggest(
      leaves, options, context.device(), arguments.operand.filename().string(), context.progress());
  const std::vector<std::uint8_t> png = encode_png(suggestions.strip);
  write_file(picture, {reinterpret_cast<const char*>(png.data()), png.size()});

  clear_progress();
  if (arguments.json) {
    print_json(arguments, suggestions.choices, picture);
  } else {
    print_table(arguments, suggestions.choices);
  }
  context.console.say("leafhull: pictures of all nine: " + picture.string());
}

std::vector<Flag> picture_flags() {
  static const ArgumentRow rows[] = {
      ArgumentRow("Output", "output", &Arguments::output, "the pictures, a row for each erosion",
                  {.range = ".png", .default_value = "TREE-suggest.png", .letter = 'o'})};
  return flags_of(rows);
}

}  // namespace

Verb suggest_verb() {
  return {.name = "suggest",
          .summary = "nine shapes of a tree to choose from, as a table and pictures",
          .about =
              "Tries erosions of 2, 12 and 25% on TREE, each with the least and the most dilation\n"
              "it allows and one between. Prints what each yields and its command, and draws it.",
          .examples =
              "  leafhull suggest birch.glb\n"
              "  leafhull suggest birch.glb --preset draft -o strip.png --json\n",
          .takes_tree = true,
          .flags = all_of({option_flags("Input"), option_flags("Leaves"),
                           option_flags("Resolution"), picture_flags(), device_flags(),
                           json_flags(), console_flags(), help_flags()}),
          .run = run_suggest};
}

}  // namespace leafhull::cli
