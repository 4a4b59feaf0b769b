// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "cli/context.h"
#include "cli/table.h"
#include "cli/values.h"
#include "cli/verb.h"
#include "leafhull/error.h"
#include "leafhull/options.h"
#include "leafhull/tree.h"

namespace leafhull::cli {
namespace {

constexpr std::size_t kMostRows = 30;

std::string_view name_of(AlphaMode mode) {
  constexpr std::string_view kNames[] = {"opaque", "mask", "blend"};
  return kNames[static_cast<std::size_t>(mode)];
}

/// A name from the file as a terminal shows it: control characters become ?, which also matches
/// them in a glob.
std::string printable(std::string name) {
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  std::replace_if(name.begin(), name.end(), is_control, '?');
  return name;
}

std::string_view name_of(LeafVerdict verdict) {
  constexpr std::string_view kNames[] = {"leaves", "no", "undergrowth", "minor", "not asked for"};
  return kNames[static_cast<std::size_t>(verdict)];
}

/// The colour as --leaves-colour takes it.
std::string text_of(const LeafColour& colour) {
  std::array<char, 8> hex{};
  std::snprintf(hex.data(), hex.size(), "#%02x%02x%02x", unsigned{colour.srgb[0]},
                unsigned{colour.srgb[1]}, unsigned{colour.srgb[2]});
  std::string text = hex.data();
  if (colour.tolerance > 0) text.append(",").append(number(colour.tolerance, 3));
  return text;
}

std::vector<std::string> suggestions(const Arguments& arguments, const LeafChoice& choice) {
  const std::string tree = quoted(arguments.operand.string());
  if (!choice.any()) {
    const std::string inspect = "leafhull inspect " + tree + ' ';
    std::vector<std::string> lines;
    for (const std::string& option : choice.options) lines.push_back(inspect + option);
    return lines;
  }
  std::string leaves;
  if (arguments.options.up) leaves += " --up " + std::string(name(*arguments.options.up));
  if (arguments.options.allow_outside) leaves += " --allow-outside";
  for (const std::string& glob : arguments.options.leaves) leaves += " --leaves " + quoted(glob);
  for (const std::string& glob : arguments.options.not_leaves) {
    leaves += " --not-leaves " + quoted(glob);
  }
  if (const auto& colour = arguments.options.leaves_colour) {
    leaves += " --leaves-colour " + quoted(text_of(*colour));
  }
  const std::string extract = "leafhull extract " + tree + leaves;
  const std::string stem = arguments.operand.stem().string();
  return {extract + " -o " + quoted(stem + "-shape.glb") + " --preset draft",
          extract + " -o " + quoted(stem + "-shape.glb") + " --preset fine",
          extract + " -o " + quoted(stem + "-thin.glb") + " --style thin"};
}

/// Candidates that a reader sees as one: they share a material or, without one, a mesh or node.
struct Row {
  const LeafCandidate* first = nullptr;
  std::size_t candidates = 0, instances = 0, triangles = 0;
  double area = 0;
};

/// The rows, likeliest first, as the candidates come.
std::vector<Row> rows_of(const std::vector<LeafCandidate>& candidates) {
  using Key = std::tuple<std::string, std::string, std::string, LeafVerdict>;
  std::map<Key, std::size_t> known;
  std::vector<Row> rows;
  for (const LeafCandidate& candidate : candidates) {
    const bool is_alone = candidate.material.empty();
    const Key key{candidate.material, is_alone ? candidate.mesh : "",
                  is_alone && candidate.mesh.empty() ? candidate.node : "", candidate.verdict};
    const auto [entry, is_new] = known.try_emplace(key, rows.size());
    if (is_new) rows.push_back({.first = &candidate});
    Row& row = rows[entry->second];
    ++row.candidates;
    row.instances += candidate.instances;
    row.triangles += candidate.triangles * candidate.instances;
    row.area += candidate.area;
  }
  return rows;
}

std::string weight(double value) {
  if (std::abs(value) < 0.05) return "";
  return (value > 0 ? "+" : "") + number(value, 2);
}

void print_candidates(const LeafChoice& choice) {
  std::vector<std::vector<std::string>> lines = {{"leaves", "material", "mesh", "colour", "alpha",
                                                  "triangles", "name", "holes", "colour", "shape",
                                                  "place", "sum"}};
  const std::vector<Row> rows = rows_of(choice.candidates);
  for (std::size_t i = 0; i < std::min(rows.size(), kMostRows); ++i) {
    const LeafCandidate& c = *rows[i].first;
    const LeafEvidence& e = c.evidence;
    const std::string mesh = c.mesh.empty() ? c.node : c.mesh;
    const std::string more =
        rows[i].candidates > 1 ? " and " + count(rows[i].candidates - 1) + " more" : "";
    lines.push_back({std::string(name_of(c.verdict)), printable(c.material), printable(mesh) + more,
                     c.colour, std::string(name_of(c.alpha_mode)), count(rows[i].triangles),
                     weight(e.name), weight(e.alpha), weight(e.colour), weight(e.shape),
                     weight(e.place), weight(e.total())});
  }
  std::cout << table(lines);
  if (rows.size() > kMostRows) {
    std::cout << "and " << count(rows.size() - kMostRows) << " more; --json lists them all\n";
  }
}

std::string text(Vec3d p) { return number(p.x, 5) + " " + number(p.y, 5) + " " + number(p.z, 5); }

/// The mean of R_u / R_v over the leaf vertices.
double slenderness(const LeafSet& leaves) {
  double sum = 0;
  for (const LeafVertex& v : leaves.vertices) sum += v.radius_major / v.radius_minor;
  return sum / static_cast<double>(leaves.vertices.size());
}

void print_fact(std::string label, const std::string& value) {
  label.resize(18, ' ');
  std::cout << label << value << '\n';
}

/// The likely unit of a tree of this height; empty for metres.
std::string likely_unit(double height) {
  if (height > 8000) return "millimetres?";
  if (height > 80) return "centimetres?";
  if (height < 0.3) return "in hundreds of metres?";
  return {};
}

/// Whether the crown lies beside the rest of the tree rather than above it.
bool lies_on_its_side(const TreeModel& tree, const LeafSet& leaves) {
  Box all = leaves.crown;
  for (const Instance& instance : tree.instances) {
    for (const Vec3f p : tree.primitives[instance.primitive].positions) {
      all.include(transformed(instance.to_world, Vec3d(p)));
    }
  }
  const Vec3d away = leaves.crown.low + leaves.crown.high - all.low - all.high;
  const double longest = all.longest_side();
  constexpr double kBeside = 0.15, kLevel = 0.04;
  return away.z > kBeside * longest && std::abs(away.y) < kLevel * longest;
}

void print_size(const TreeModel& tree, const LeafSet& leaves, std::optional<Up> up) {
  const Vec3d size = leaves.crown.size();
  std::string text =
      number(size.x, 4) + " wide, " + number(size.y, 4) + " high, " + number(size.z, 4) + " deep";
  if (const std::string unit = likely_unit(size.y); !unit.empty()) text += ": " + unit;
  if (!up && lies_on_its_side(tree, leaves)) text += "; on its side? --up z stands it up";
  print_fact("crown size", text);
}

void print_leaves(const TreeModel& tree, const LeafSet& leaves, const LeafChoice& choice,
                  std::optional<Up> up) {
  const double crown_unit = leaves.crown.longest_side() / kCrownUnits;
  std::cout << '\n' << printable(choice.told) << '\n';
  print_fact("leaves", count(leaves.leaf_count));
  print_fact("leaf vertices", count(leaves.vertices.size()));
  print_fact("dropped leaves", count(leaves.dropped_leaves));
  print_fact("split components", count(leaves.split_components));
  print_fact("mean R_u", number(leaves.mean_radius_major, 4) + " model units, " +
                             number(leaves.mean_radius_major / crown_unit, 3) + " crown units");
  print_fact("mean R_u / R_v", number(slenderness(leaves), 3));
  print_fact("bounding box", text(leaves.bounds.low) + "  to  " + text(leaves.bounds.high));
  if (leaves.stray_leaves > 0) {
    print_fact("crown", text(leaves.crown.low) + "  to  " + text(leaves.crown.high));
    print_fact("stray leaves", count(leaves.stray_leaves));
  }
  print_size(tree, leaves, up);
  print_fact("crown unit", number(crown_unit, 4) + " model units");
}

using Json = nlohmann::ordered_json;

Json json(Vec3d p) { return Json::array({p.x, p.y, p.z}); }

Json json(const LeafSet& leaves) {
  return {{"leaves", leaves.leaf_count},
          {"leaf_vertices", leaves.vertices.size()},
          {"dropped_leaves", leaves.dropped_leaves},
          {"split_components", leaves.split_components},
          {"mean_radius_major", leaves.mean_radius_major},
          {"mean_radius_ratio", slenderness(leaves)},
          {"bounds", {{"low", json(leaves.bounds.low)}, {"high", json(leaves.bounds.high)}}},
          {"crown", {{"low", json(leaves.crown.low)}, {"high", json(leaves.crown.high)}}},
          {"stray_leaves", leaves.stray_leaves},
          {"crown_unit", leaves.crown.longest_side() / kCrownUnits}};
}

Json json(const LeafCandidate& candidate) {
  const LeafEvidence& evidence = candidate.evidence;
  return {{"material", candidate.material},
          {"mesh", candidate.mesh},
          {"node", candidate.node},
          {"alpha_mode", name_of(candidate.alpha_mode)},
          {"colour", candidate.colour.empty() ? Json() : Json(candidate.colour)},
          {"is_part", candidate.is_part},
          {"instances", candidate.instances},
          {"vertices", candidate.vertices},
          {"triangles", candidate.triangles},
          {"area", candidate.area},
          {"word", candidate.word},
          {"evidence",
           {{"name", evidence.name},
            {"holes", evidence.alpha},
            {"colour", evidence.colour},
            {"shape", evidence.shape},
            {"place", evidence.place},
            {"sum", evidence.total()}}},
          {"verdict", name_of(candidate.verdict)},
          {"leaves", candidate.verdict == LeafVerdict::leaves}};
}

void print_json(const Arguments& arguments, const LeafChoice& choice,
                const std::optional<LeafSet>& leaves, const std::vector<std::string>& commands) {
  Json candidates = Json::array();
  for (const LeafCandidate& candidate : choice.candidates) candidates.push_back(json(candidate));
  const Json page = {{"input", arguments.operand.string()},
                     {"candidates", candidates},
                     {"chosen", choice.told},
                     {"leaves", leaves ? json(*leaves) : Json()},
                     {"suggestions", commands}};
  // Names come from the file and need not be UTF-8.
  std::cout << page.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void run_inspect(const Arguments& arguments) {
  Context context(arguments);
  const LeafOptions options = resolve(arguments.options).leaf_options();
  const TreeModel tree = context.read(arguments.operand);
  context.console.progress("leaves", 0);
  const LeafChoice choice = choose_leaves(tree, options);
  std::optional<LeafSet> leaves;
  std::optional<Error> failure;
  try {
    leaves = find_leaves(tree, choice, options);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::input) throw;
    failure = error;  // the list is printed all the same
  }
  clear_progress();
  context.warn(leaves ? leaves->warnings : choice.warnings);

  const std::vector<std::string> commands = suggestions(arguments, choice);
  if (arguments.json) {
    print_json(arguments, choice, leaves, commands);
  } else {
    print_candidates(choice);
    if (leaves) print_leaves(tree, *leaves, choice, arguments.options.up);
    std::cout << "\nTry\n";
    for (const std::string& command : commands) std::cout << "  " << command << '\n';
  }
  if (failure) throw Error(*failure);
}

}  // namespace

Verb inspect_verb() {
  return {.name = "inspect",
          .summary = "what a file holds, its leaves, and what to type next",
          .about = "Lists what TREE holds and what would be taken as leaves.",
          .examples =
              "  leafhull inspect birch.glb\n"
              "  leafhull inspect birch.glb --leaves '*twig*' --json\n",
          .takes_tree = true,
          .flags = all_of({option_flags("Input"), option_flags("Leaves"), json_flags(),
                           console_flags(), help_flags()}),
          .run = run_inspect};
}

}  // namespace leafhull::cli
