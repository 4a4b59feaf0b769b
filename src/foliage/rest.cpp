// SPDX-License-Identifier: Apache-2.0
#include "foliage/rest.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace leafhull {
namespace {

/// The primitive without its leaves.
Primitive without(const Primitive& primitive, const std::vector<bool>& leaves) {
  Primitive rest = primitive;
  rest.triangles.clear();
  for (std::size_t t = 0; t < primitive.triangles.size(); ++t) {
    if (!leaves[t]) rest.triangles.push_back(primitive.triangles[t]);
  }
  return rest;
}

}  // namespace

Rest rest_of(std::shared_ptr<const TreeModel> tree, const LeafChoice& choice) {
  Rest rest;
  std::map<std::uint32_t, std::uint32_t> cut;  // primitives and what is left of them
  std::vector<Primitive> more;
  for (std::size_t i = 0; i < tree->instances.size(); ++i) {
    Instance instance = tree->instances[i];
    if (choice.left_out[i] || tree->primitives[instance.primitive].triangles.empty()) continue;
    if (choice.instances[i]) {
      const std::vector<bool>& leaves = choice.triangles[instance.primitive];
      if (leaves.empty()) continue;
      const auto number = static_cast<std::uint32_t>(tree->primitives.size() + more.size());
      const auto [known, is_new] = cut.try_emplace(instance.primitive, number);
      if (is_new) more.push_back(without(tree->primitives[instance.primitive], leaves));
      instance.primitive = known->second;
    }
    rest.instances.push_back(std::move(instance));
  }
  if (!more.empty()) {
    auto model = std::make_shared<TreeModel>(*tree);
    std::ranges::move(more, std::back_inserter(model->primitives));
    tree = std::move(model);
  }
  rest.model = std::move(tree);
  return rest;
}

}  // namespace leafhull
