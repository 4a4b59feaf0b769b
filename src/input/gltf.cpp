// SPDX-License-Identifier: Apache-2.0
#include "input/gltf.h"

#include <vector>

#include "input/gltf_meshes.h"
#include "input/input_error.h"

namespace leafhull {

TreeModel read_gltf(ByteSpan bytes, const std::string& name, const Companions& companions) {
  std::vector<Instance> instances;
  const auto place = [&](const GltfMeshes& meshes, const PlacedMesh& placed) {
    if (!is_finite(placed.to_world)) {
      input_error(name, place_of(placed), "has a transform that is not finite");
    }
    for (const std::uint32_t primitive : meshes.primitives.at(placed.mesh)) {
      instances.push_back({primitive, placed.node_name, placed.to_world, placed.node});
    }
  };
  TreeModel tree = read_gltf_meshes(bytes, name, companions, place).tree;
  tree.instances = std::move(instances);
  if (tree.instances.empty()) {
    input_error(name, "", "holds no triangles in its default scene",
                "Export the tree as triangle meshes.");
  }
  return tree;
}

}  // namespace leafhull
