// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/console.h"
#include "cli/table.h"
#include "cli/values.h"
#include "cli/verb.h"
#include "leafhull/error.h"
#include "leafhull/options.h"
#include "leafhull/tree.h"

namespace leafhull::cli {
namespace {

constexpr std::size_t kGuesses = 3;

std::string_view name_of(AlphaMode mode) {
  constexpr std::string_view kNames[] = {"opaque", "mask", "blend"};
  return kNames[static_cast<std::size_t>(mode)];
}

/// What a name from the file shows on a terminal: control characters become ?, which also matches
/// them in a glob.
std::string printable(std::string name) {
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7F; };
  std::replace_if(name.begin(), name.end(), is_control, '?');
  return name;
}

/// A glob that matches `name`: what would be special in it matches any character.
std::string glob_of(const std::string& name) {
  std::string glob = printable(name);
  for (char& c : glob) {
    if (std::string_view("*?[]\\").find(c) != std::string_view::npos) c = '?';
  }
  return glob;
}

std::string first_named(const PrimitiveSummary& row) {
  for (const std::string& name : {row.material, row.mesh, row.node}) {
    if (!name.empty()) return name;
  }
  return {};
}

/// Where nothing looks like leaves: the names with the most triangles, which leaves usually are.
std::vector<std::string> likely_leaves(std::vector<PrimitiveSummary> rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return a.triangles * a.instances > b.triangles * b.instances;
  });
  std::vector<std::string> globs;
  for (const PrimitiveSummary& row : rows) {
    const std::string glob = glob_of(first_named(row));
    if (!glob.empty() && std::find(globs.begin(), globs.end(), glob) == globs.end()) {
      globs.push_back(glob);
    }
    if (globs.size() == kGuesses) break;
  }
  return globs.empty() ? std::vector<std::string>{"*"} : globs;
}

std::vector<std::string> suggestions(const Arguments& arguments,
                                     const std::vector<PrimitiveSummary>& rows, bool found) {
  const std::string tree = quoted(arguments.tree.string());
  if (!found) {
    std::vector<std::string> lines;
    for (const std::string& glob : likely_leaves(rows)) {
      lines.push_back("leafhull inspect " + tree + " --leaves " + quoted(glob));
    }
    return lines;
  }
  std::string leaves;
  for (const std::string& glob : arguments.options.leaves) leaves += " --leaves " + quoted(glob);
  const std::string extract = "leafhull extract " + tree + leaves;
  const std::string stem = arguments.tree.stem().string();
  return {extract + " -o " + quoted(stem + "-shape.glb") + " --preset draft",
          extract + " -o " + quoted(stem + "-shape.glb") + " --preset fine",
          extract + " -o " + quoted(stem + "-thin.glb") + " --style thin --threshold 40%"};
}

void print_primitives(const std::vector<PrimitiveSummary>& rows) {
  std::vector<std::vector<std::string>> lines = {
      {"material", "mesh", "node", "alpha", "instances", "vertices", "triangles", "leaf"}};
  for (const PrimitiveSummary& row : rows) {
    lines.push_back({printable(row.material), printable(row.mesh), printable(row.node),
                     std::string(name_of(row.alpha_mode)), count(row.instances),
                     count(row.vertices), count(row.triangles), row.leaves ? "yes" : "no"});
  }
  std::cout << table(lines);
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

void print_leaves(const LeafSet& leaves) {
  const double crown_unit = leaves.crown.longest_side() / kCrownUnits;
  std::cout << '\n';
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

void print_json(const Arguments& arguments, const std::vector<PrimitiveSummary>& rows,
                const std::optional<LeafSet>& leaves, const std::vector<std::string>& commands) {
  Json primitives = Json::array();
  for (const PrimitiveSummary& row : rows) {
    primitives.push_back({{"material", row.material},
                          {"mesh", row.mesh},
                          {"node", row.node},
                          {"alpha_mode", name_of(row.alpha_mode)},
                          {"instances", row.instances},
                          {"vertices", row.vertices},
                          {"triangles", row.triangles},
                          {"leaves", row.leaves}});
  }
  const Json page = {{"input", arguments.tree.string()},
                     {"primitives", primitives},
                     {"leaves", leaves ? json(*leaves) : Json()},
                     {"suggestions", commands}};
  // Names come from the file and need not be UTF-8.
  std::cout << page.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void run_inspect(const Arguments& arguments) {
  Console console(arguments.quiet, arguments.verbose);
  const LeafOptions options = resolve(arguments.options).leaf_options();
  console.progress("read", 0);
  const TreeModel tree = read_tree(arguments.tree);
  for (const std::string& warning : tree.warnings) console.warn(warning);
  const std::vector<PrimitiveSummary> rows = summarize(tree, options);

  std::optional<LeafSet> leaves;
  std::optional<Error> failure;
  try {
    console.progress("leaves", 0);
    leaves = find_leaves(tree, options);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::input) throw;
    failure = error;  // the list is printed all the same
  }
  clear_progress();
  if (leaves) {
    for (const std::string& warning : leaves->warnings) console.warn(warning);
  }

  const std::vector<std::string> commands = suggestions(arguments, rows, leaves.has_value());
  if (arguments.json) {
    print_json(arguments, rows, leaves, commands);
  } else {
    print_primitives(rows);
    if (leaves) print_leaves(*leaves);
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
          .flags = all_of({option_flags("Leaves"), json_flags(), console_flags(), help_flags()}),
          .run = run_inspect};
}

}  // namespace leafhull::cli
