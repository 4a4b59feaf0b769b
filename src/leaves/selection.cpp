// SPDX-License-Identifier: Apache-2.0
#include "leaves/selection.h"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>

#include "leafhull/error.h"

namespace leafhull {
namespace {

constexpr std::size_t kNamesListed = 20;

constexpr std::array kUsualNames{"*leaf*", "*leaves*", "*foliage*", "*needle*"};

using Names = std::array<std::string_view, 3>;

const Material* material_of(const TreeModel& tree, const Instance& instance) {
  const int material = tree.primitives[instance.primitive].material;
  return material < 0 ? nullptr : &tree.materials[material];
}

Names names_of(const TreeModel& tree, const Instance& instance) {
  const Material* material = material_of(tree, instance);
  return {material ? material->name : std::string_view{},
          tree.primitives[instance.primitive].mesh_name, instance.node_name};
}

AlphaMode alpha_mode_of(const TreeModel& tree, const Instance& instance) {
  const Material* material = material_of(tree, instance);
  return material ? material->alpha_mode : AlphaMode::opaque;
}

bool matches(const char* glob, const Names& names) {
  return std::ranges::any_of(names, [&](std::string_view name) {
    return fnmatch(glob, std::string(name).c_str(), FNM_CASEFOLD | FNM_NOESCAPE) == 0;
  });
}

/// A name fit for a message of one line: control characters become ?, which also matches them.
std::string printable(std::string_view name) {
  std::string text(name);
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
  return text;
}

/// "materials bark, twig; meshes trunk; nodes tree", each name once.
std::string list_names(const TreeModel& tree, std::span<const Instance> instances) {
  static constexpr std::array kKinds{"materials", "meshes", "nodes"};
  std::array<std::set<std::string_view>, 3> distinct;
  for (const Instance& instance : instances) {
    const Names names = names_of(tree, instance);
    for (std::size_t kind = 0; kind < names.size(); ++kind) {
      if (!names[kind].empty()) distinct[kind].insert(names[kind]);
    }
  }
  std::string list;
  std::size_t listed = 0;
  std::size_t left_out = 0;
  for (std::size_t kind = 0; kind < distinct.size(); ++kind) {
    std::string separator = (list.empty() ? "" : "; ") + std::string(kKinds[kind]) + " ";
    for (const std::string_view name : distinct[kind]) {
      if (listed == kNamesListed) {
        ++left_out;
        continue;
      }
      list.append(separator).append(printable(name));
      separator = ", ";
      ++listed;
    }
  }
  if (left_out > 0) list += " and " + std::to_string(left_out) + " more";
  return list.empty() ? "nothing in it has a name" : "it holds " + list;
}

[[noreturn]] void throw_no_leaves(const TreeModel& tree, std::span<const Instance> instances,
                                  const LeafOptions& options) {
  const std::string file = tree.path.empty() ? "the tree" : tree.path.string();
  if (instances.empty()) {
    throw Error(ErrorCode::input, file + " holds no triangles",
                "Export the tree as triangle meshes.");
  }
  const char* reason = options.globs.empty()
                           ? ": no masked or blended material and no name with leaf, leaves, "
                             "foliage or needle; "
                           : ": --leaves matches no material, mesh or node; ";
  throw Error(ErrorCode::input, "no leaves in " + file + reason + list_names(tree, instances),
              "Name the leaves with --leaves GLOB.");
}

}  // namespace

bool is_leaf(const TreeModel& tree, const Instance& instance, const LeafOptions& options) {
  const Names names = names_of(tree, instance);
  if (!options.globs.empty()) {
    return std::ranges::any_of(
        options.globs, [&](const std::string& glob) { return matches(glob.c_str(), names); });
  }
  return alpha_mode_of(tree, instance) != AlphaMode::opaque ||
         std::ranges::any_of(kUsualNames, [&](const char* glob) { return matches(glob, names); });
}

std::vector<PrimitiveSummary> summarize(const TreeModel& tree, const LeafOptions& options) {
  std::vector<std::vector<PrimitiveSummary>> by_primitive(tree.primitives.size());
  std::map<std::pair<std::uint32_t, std::string_view>, std::size_t> row_of;
  for (const Instance& instance : tree.instances) {
    auto& rows = by_primitive[instance.primitive];
    const auto [row, is_new] =
        row_of.try_emplace({instance.primitive, instance.node_name}, rows.size());
    if (is_new) {
      const Primitive& primitive = tree.primitives[instance.primitive];
      const auto [material, mesh, node] = names_of(tree, instance);
      rows.push_back({std::string(material), std::string(mesh), std::string(node),
                      alpha_mode_of(tree, instance), 0, primitive.positions.size(),
                      primitive.triangles.size(), is_leaf(tree, instance, options)});
    }
    ++rows[row->second].instances;
  }
  std::vector<PrimitiveSummary> summary;
  for (auto& rows : by_primitive) std::ranges::move(rows, std::back_inserter(summary));
  return summary;
}

std::vector<std::uint32_t> select_leaves(const TreeModel& tree, std::span<const Instance> instances,
                                         const LeafOptions& options,
                                         std::vector<std::string>& warnings) {
  std::vector<std::uint32_t> selected(instances.size());
  std::iota(selected.begin(), selected.end(), 0u);
  std::erase_if(selected, [&](auto i) { return !is_leaf(tree, instances[i], options); });
  if (selected.empty()) throw_no_leaves(tree, instances, options);

  for (const std::string& glob : options.globs) {
    const bool used = std::ranges::any_of(selected, [&](std::uint32_t i) {
      return matches(glob.c_str(), names_of(tree, instances[i]));
    });
    if (!used) warnings.push_back("--leaves " + glob + " matches no material, mesh or node");
  }
  std::ranges::stable_sort(selected, {}, [&](auto i) { return instances[i].primitive; });
  return selected;
}

}  // namespace leafhull
