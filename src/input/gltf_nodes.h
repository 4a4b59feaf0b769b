// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "input/gltf_file.h"
#include "input/gltf_meshes.h"
#include "leafhull/tree.h"

namespace leafhull {

/// A camera of the file put into the scene by a node.
struct PlacedCamera {
  int camera = 0;
  std::string place;  ///< of the node, for messages
  Transform to_world = kIdentity;
};

/// The numbers of the meshes that the nodes of the default scene hold (else of the first, else all
/// nodes).
/// @throws Error input: nodes that are not a tree; no such mesh.
std::set<int> placed_meshes(const GltfFile& file);

/// The same meshes as the nodes place them, in depth-first order, each copy of
/// EXT_mesh_gpu_instancing for itself. Skins and animations are at rest.
/// @throws Error input, as placed_meshes; the attributes of the copies.
void place_meshes(GltfFile& file, const std::function<void(const PlacedMesh&)>& place);

/// All nodes of the file by their numbers.
std::vector<TreeNode> node_table(const GltfFile& file);

/// The cameras of the same nodes in the same order.
/// @throws Error input: nodes that are not a tree, or a camera's transform that is not finite.
std::vector<PlacedCamera> place_cameras(const GltfFile& file);

}  // namespace leafhull
