// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include "leafhull/error.h"
#include "leafhull/leaves.h"
#include "leaves/alpha_mask.h"
#include "leaves/collect_leaves.h"
#include "leaves/crown.h"
#include "leaves/leaf_components.h"
#include "leaves/order.h"

namespace leafhull {
namespace {

void check(const LeafOptions& options) {
  if (!(options.scale > 0) || !std::isfinite(options.scale)) {
    throw Error(ErrorCode::usage, "--leaf-scale is not a positive number",
                "Give the factor for the leaves' radii, 1 to leave them.");
  }
  if (!options.ellipse) return;
  const auto& [centre, a, b] = *options.ellipse;
  const double area = a.x * b.y - a.y * b.x;
  if (!std::isfinite(area) || !std::isfinite(centre.x + centre.y) || area == 0) {
    throw Error(ErrorCode::usage, "--ellipse has half axes along one line or of no length",
                "Give cu,cv,au,av,bu,bv: its centre and two half axes in texture space.");
  }
}

/// Memory is reserved for at most this many vertices, 1 GiB. Reserved memory costs nothing until it
/// is used.
constexpr std::size_t kMostReserved = std::size_t{1} << 24;

/// The visible parts of textures, by material.
class Masks {
 public:
  Masks(const TreeModel& tree, const LeafChoice& choice) : tree_(tree), choice_(choice) {}

  /// Null where nothing of the texture is cut away.
  std::shared_ptr<AlphaMask> of(int material) {
    if (material < 0) return nullptr;
    const auto [known, is_new] = masks_.try_emplace(material);
    if (is_new) known->second = make(static_cast<std::size_t>(material));
    return known->second;
  }
  /// Materials whose texture is cut away everywhere, by name.
  const std::vector<std::string>& hidden() const { return hidden_; }

 private:
  std::shared_ptr<AlphaMask> make(std::size_t number) {
    const Material& material = tree_.materials[number];
    const bool cut_out = number < choice_.cut_out.size() && choice_.cut_out[number];
    std::optional<AlphaMask> mask = AlphaMask::of(material, tree_.images, cut_out);
    if (!mask) return nullptr;
    if (!mask->keeps_any()) {
      hidden_.push_back(material.name);
      return nullptr;
    }
    return std::make_shared<AlphaMask>(std::move(*mask));
  }

  const TreeModel& tree_;
  const LeafChoice& choice_;
  std::map<int, std::shared_ptr<AlphaMask>> masks_;
  std::vector<std::string> hidden_;
};

/// The chosen instances, those of a primitive side by side.
std::vector<std::uint32_t> chosen_instances(std::span<const Instance> instances,
                                            const LeafChoice& choice) {
  std::vector<std::uint32_t> chosen(instances.size());
  std::iota(chosen.begin(), chosen.end(), 0u);
  std::erase_if(chosen, [&](std::uint32_t i) { return !choice.instances[i]; });
  std::ranges::stable_sort(chosen, {}, [&](auto i) { return instances[i].primitive; });
  return chosen;
}

WeldedMesh weld_chosen(const Primitive& primitive, const LeafChoice& choice, std::size_t index) {
  const std::vector<bool>& triangles = choice.triangles[index];
  if (choice.welded && index < choice.welded->of.size()) {
    const std::vector<std::uint32_t>& welded = choice.welded->of[index];
    if (is_welded(primitive, welded)) return weld(primitive, welded, triangles);
  }
  return weld(primitive, weld_positions(primitive), triangles);
}

/// The choice as kept in LeafSet::choice, for callers that ask how the leaves were found.
std::shared_ptr<const LeafChoice> told(LeafChoice choice) {
  choice.welded.reset();
  return std::make_shared<const LeafChoice>(std::move(choice));
}

FoundLeaves collect_all(const TreeModel& tree, std::span<const Instance> instances,
                        const LeafChoice& choice, const LeafOptions& options, Masks& masks) {
  const std::vector<std::uint32_t> chosen = chosen_instances(instances, choice);
  FoundLeaves found;
  std::size_t vertices = 0;
  for (const std::uint32_t i : chosen) {
    vertices += tree.primitives[instances[i].primitive].positions.size();
  }
  found.vertices.reserve(std::min(vertices, kMostReserved));
  found.sheets.reserve(std::min(vertices, kMostReserved) / 3);
  for (auto first = chosen.begin(); first != chosen.end();) {
    const std::uint32_t index = instances[*first].primitive;
    const Primitive& primitive = tree.primitives[index];
    const WeldedMesh mesh = weld_chosen(primitive, choice, index);
    const FaceGroups components = connected_components(mesh);
    LeafSource source{primitive, mesh, components};
    source.texture = {primitive.uvs, options.ellipse, masks.of(primitive.material)};
    source.scale = options.scale;
    for (; first != chosen.end() && instances[*first].primitive == index; ++first) {
      source.to_world.push_back(instances[*first].to_world);
    }
    collect_leaves(source, found);
  }
  return found;
}

std::string untextured_warning(std::size_t count) {
  const std::string why = " no usable texture coordinates or no part of the texture; ";
  if (count == 1) return "1 leaf has" + why + "its ellipse is that of its triangles";
  return std::to_string(count) + " leaves have" + why +
         "their ellipses are those of their triangles";
}

std::string invisible_warning(std::size_t count) {
  if (count == 1) return "1 leaf shows nothing of its texture that is not transparent";
  return std::to_string(count) + " leaves show nothing of their texture that is not transparent";
}

std::string no_usable_leaf(std::size_t dropped, const std::string& file) {
  const std::string which =
      dropped == 1 ? "the one leaf of " + file + " does not have"
                   : "none of the " + std::to_string(dropped) + " leaves of " + file + " has";
  return which + " an area and finite values";
}

/// The mean R_u, counting each leaf once, summed in the order of leaf numbers.
double mean_radius_major(const LeafSet& leaves) {
  double sum = 0;
  std::uint32_t next = 0;
  for (const LeafVertex& vertex : leaves.vertices) {
    if (vertex.leaf < next) continue;
    sum += vertex.radius_major;
    ++next;
  }
  return sum / static_cast<double>(leaves.leaf_count);
}

}  // namespace

LeafSet find_leaves(const TreeModel& tree, std::span<const Instance> instances,
                    const LeafChoice& choice, const LeafOptions& options) {
  check(options);
  LeafSet leaves;
  leaves.choice = told(choice);
  leaves.colour = choice.colour;
  leaves.warnings = choice.warnings;
  Masks masks(tree, choice);
  FoundLeaves found = collect_all(tree, instances, choice, options, masks);
  leaves.leaf_count = found.count;
  leaves.dropped_leaves = found.dropped;
  leaves.split_components = found.split;
  leaves.vertices = std::move(found.vertices);
  if (leaves.vertices.empty()) {
    throw Error(ErrorCode::input, no_usable_leaf(leaves.dropped_leaves, tree.path.string()),
                "Look at the model with leafhull inspect, or choose other leaves with --leaves.");
  }
  if (found.untextured > 0) leaves.warnings.push_back(untextured_warning(found.untextured));
  for (const std::string& material : masks.hidden()) {
    leaves.warnings.push_back(
        "the texture of material '" + material +
        "' is transparent everywhere; its leaves are taken as whole triangles");
  }
  leaves.bounds = found.bounds;
  const Crown crown = find_crown(leaves);
  leaves.crown = crown.box;
  leaves.stray_leaves = crown.strays;
  if (crown.strays > 0) leaves.warnings.push_back(stray_warning(crown));
  sort_vertices(leaves);
  leaves.sheets = found.sheets.finish(leaves.crown);
  leaves.area = leaves.sheets->area;
  if (const std::size_t invisible = leaves.sheets->invisible; invisible > 0) {
    leaves.warnings.push_back(invisible_warning(invisible));
  }
  leaves.mean_radius_major = mean_radius_major(leaves);
  return leaves;
}

}  // namespace leafhull
