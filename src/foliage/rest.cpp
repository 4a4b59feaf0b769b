// SPDX-License-Identifier: Apache-2.0
#include "foliage/rest.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace leafhull {
namespace {

/// The triangles of the primitive that are leaves or, if not `leaves`, the others.
Primitive cut(const Primitive& primitive, const std::vector<bool>& are_leaves, bool leaves) {
  Primitive part = primitive;
  part.triangles.clear();
  for (std::size_t t = 0; t < primitive.triangles.size(); ++t) {
    if (are_leaves[t] == leaves) part.triangles.push_back(primitive.triangles[t]);
  }
  return part;
}

/// The leaves of a tree or, if not `leaves`, everything else.
TreePart part_of(std::shared_ptr<const TreeModel> tree, const LeafChoice& choice, bool leaves) {
  TreePart part;
  std::map<std::uint32_t, std::uint32_t> known;  // primitives and what is cut out of them
  std::vector<Primitive> more;
  for (std::size_t i = 0; i < tree->instances.size(); ++i) {
    Instance instance = tree->instances[i];
    if (choice.left_out[i] || tree->primitives[instance.primitive].triangles.empty()) continue;
    if (!choice.instances[i]) {
      if (!leaves) part.instances.push_back(std::move(instance));
      continue;
    }
    const std::vector<bool>& are_leaves = choice.triangles[instance.primitive];
    if (!are_leaves.empty()) {
      const auto number = static_cast<std::uint32_t>(tree->primitives.size() + more.size());
      const auto [place, is_new] = known.try_emplace(instance.primitive, number);
      if (is_new) more.push_back(cut(tree->primitives[instance.primitive], are_leaves, leaves));
      instance.primitive = place->second;
    } else if (!leaves) {
      continue;
    }
    part.instances.push_back(std::move(instance));
  }
  if (!more.empty()) {
    auto model = std::make_shared<TreeModel>(*tree);
    std::ranges::move(more, std::back_inserter(model->primitives));
    tree = std::move(model);
  }
  part.model = std::move(tree);
  return part;
}

}  // namespace

TreePart rest_of(std::shared_ptr<const TreeModel> tree, const LeafChoice& choice) {
  return part_of(std::move(tree), choice, false);
}

TreePart leaves_of(std::shared_ptr<const TreeModel> tree, const LeafChoice& choice) {
  return part_of(std::move(tree), choice, true);
}

}  // namespace leafhull
