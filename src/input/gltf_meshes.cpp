// SPDX-License-Identifier: Apache-2.0
#include "input/gltf_meshes.h"

#include <map>

#include "input/gltf_file.h"
#include "input/gltf_materials.h"
#include "input/gltf_nodes.h"
#include "input/gltf_primitive.h"

namespace leafhull {

GltfMeshes read_gltf_meshes(ByteSpan bytes, const std::string& name, const Companions& companions,
                            const MeshVisitor& visit, const MeshVisitor& survey) {
  GltfFile file = open_gltf(bytes, name, companions);
  GltfMeshes meshes;
  TreeModel& tree = meshes.tree;
  const std::map<MeshUse, int> uses = mesh_uses(file);
  const std::vector<Transform> to_world = node_transforms(file);
  tree.nodes = node_table(file);
  MaterialReader materials(file, tree);
  materials.read_all();
  for (const auto& [use, number] : uses) {
    const GltfPose pose = pose_of(file, use, to_world);
    const std::size_t count = file.model.meshes[use.mesh].primitives.size();
    for (std::size_t i = 0; i < count; ++i) {
      auto primitive = read_primitive(file, static_cast<std::size_t>(use.mesh), i, materials, pose,
                                      tree.warnings);
      if (!primitive) continue;
      meshes.primitives[number].push_back(static_cast<std::uint32_t>(tree.primitives.size()));
      tree.primitives.push_back(std::move(*primitive));
    }
  }
  materials.decode_images();
  tree.warnings.insert(tree.warnings.begin(), file.notes.begin(), file.notes.end());
  for (const MeshVisitor* visitor : {&survey, &visit}) {
    if (!*visitor) continue;
    place_meshes(file, uses, [&](const PlacedMesh& placed_mesh) {
      if (meshes.primitives.contains(placed_mesh.mesh)) (*visitor)(meshes, placed_mesh);
    });
  }
  return meshes;
}

}  // namespace leafhull
