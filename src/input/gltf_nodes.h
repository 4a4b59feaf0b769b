// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "input/gltf_file.h"
#include "input/gltf_meshes.h"
#include "input/gltf_pose.h"
#include "leafhull/tree.h"

namespace leafhull {

/// A camera of the file put into the scene by a node.
struct PlacedCamera {
  int camera = 0;
  std::string place;  ///< of the node, for messages
  Transform to_world = kIdentity;
};

/// How the nodes of the default scene (else of the first, else all nodes) use meshes, with a number
/// for each use: the mesh's own, or a number past all meshes if it is posed. Hidden nodes are left
/// out and counted in the file's notes.
/// @throws Error input: nodes that are not a tree; no such mesh or skin.
std::map<MeshUse, int> mesh_uses(GltfFile& file);

/// The world transform of each node of the file; the identity for nodes outside the scene.
std::vector<Transform> node_transforms(const GltfFile& file);

/// Visits the same meshes, by their numbers in `uses`, as nodes place them, in depth-first order;
/// copies of EXT_mesh_gpu_instancing come singly. Skinned meshes are in world coordinates already.
/// @throws Error input, as mesh_uses; the attributes of the copies.
void place_meshes(GltfFile& file, const std::map<MeshUse, int>& uses,
                  const std::function<void(const PlacedMesh&)>& place);

/// All nodes of the file by their numbers.
std::vector<TreeNode> node_table(const GltfFile& file);

/// The cameras of the same nodes in the same order.
/// @throws Error input: nodes that are not a tree, or a camera's transform that is not finite.
std::vector<PlacedCamera> place_cameras(const GltfFile& file);

}  // namespace leafhull
