// SPDX-License-Identifier: Apache-2.0
#include "input/gltf.h"

#include <map>
#include <vector>

#include "input/gltf_file.h"
#include "input/gltf_materials.h"
#include "input/gltf_nodes.h"
#include "input/gltf_primitive.h"

namespace leafhull {

TreeModel read_gltf(ByteSpan bytes, const std::string& name,
                    const std::optional<std::filesystem::path>& folder) {
  GltfFile file = open_gltf(bytes, name, folder);
  const std::vector<PlacedMesh> placements = place_meshes(file);

  TreeModel tree;
  MaterialReader materials(file, tree);
  materials.read_all();
  // Primitives of the tree by mesh, in file order; a mesh that nothing places is not read.
  std::map<int, std::vector<std::uint32_t>> primitives;
  for (const PlacedMesh& placement : placements) primitives[placement.mesh];
  for (auto& [mesh, numbers] : primitives) {
    const std::size_t count = file.model.meshes[mesh].primitives.size();
    for (std::size_t i = 0; i < count; ++i) {
      auto primitive =
          read_primitive(file, static_cast<std::size_t>(mesh), i, materials, tree.warnings);
      if (!primitive) continue;
      numbers.push_back(static_cast<std::uint32_t>(tree.primitives.size()));
      tree.primitives.push_back(std::move(*primitive));
    }
  }
  for (const PlacedMesh& placement : placements) {
    for (const std::uint32_t primitive : primitives[placement.mesh]) {
      tree.instances.push_back({primitive, placement.node_name, placement.to_world});
    }
  }
  if (tree.instances.empty()) {
    file.fail("", "holds no triangles in its default scene", "Export the tree as triangle meshes.");
  }
  return tree;
}

}  // namespace leafhull
