// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

#include "foliage/words.h"
#include "leafhull/error.h"
#include "leafhull/leaves.h"

namespace leafhull {
namespace {

constexpr std::size_t kNamesListed = 20;

/// "materials bark, twig; meshes trunk; nodes tree", each name once.
std::string list_names(const std::vector<LeafCandidate>& candidates) {
  static constexpr std::array kKinds{"materials", "meshes", "nodes"};
  std::array<std::set<std::string_view>, 3> distinct;
  for (const LeafCandidate& candidate : candidates) {
    const std::array<std::string_view, 3> names{candidate.material, candidate.mesh, candidate.node};
    for (std::size_t kind = 0; kind < names.size(); ++kind) {
      if (!names[kind].empty()) distinct[kind].insert(names[kind]);
    }
  }
  std::string list;
  std::size_t listed = 0, left_out = 0;
  for (std::size_t kind = 0; kind < distinct.size(); ++kind) {
    std::string separator = (list.empty() ? "" : "; ") + std::string(kKinds[kind]) + " ";
    for (const std::string_view name : distinct[kind]) {
      if (listed == kNamesListed) {
        ++left_out;
        continue;
      }
      list.append(separator).append(printable_name(name));
      separator = ", ";
      ++listed;
    }
  }
  if (left_out > 0) list += " and " + std::to_string(left_out) + " more";
  return list.empty() ? "it holds no names" : "it holds " + list;
}

}  // namespace

void throw_no_leaves(const TreeModel& tree, const LeafChoice& choice, const LeafOptions& options) {
  const std::string file = tree.path.empty() ? "the tree" : tree.path.string();
  if (choice.candidates.empty()) {
    throw Error(ErrorCode::input, file + " holds no triangles",
                "Export the tree as triangle meshes.");
  }
  const std::string names = list_names(choice.candidates);
  if (!options.globs.empty()) {
    throw Error(
        ErrorCode::input,
        "no leaves in " + file + ": --leaves matches no material, mesh, node or path; " + names,
        "Name the leaves with --leaves GLOB.");
  }
  const auto likeliest = std::ranges::max_element(
      choice.candidates, {}, [](const LeafCandidate& c) { return c.evidence.total(); });
  throw Error(ErrorCode::input,
              "no leaves in " + file + ": names, holes, colours and shapes show none; " + names,
              "If they are " + label(*likeliest) + ", say so with " + option_for(*likeliest) + ".");
}

LeafSet find_leaves(const TreeModel& tree, const LeafOptions& options) {
  return find_leaves(tree, choose_leaves(tree, options), options);
}

LeafSet find_leaves(const TreeModel& tree, const LeafChoice& choice, const LeafOptions& options) {
  if (!choice.any()) throw_no_leaves(tree, choice, options);
  return find_leaves(tree, tree.instances, choice, options);
}

}  // namespace leafhull
