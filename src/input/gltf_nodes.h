// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "input/gltf_file.h"
#include "leafhull/tree.h"

namespace leafhull {

/// A mesh of the file put into the scene by a node.
struct PlacedMesh {
  int mesh = 0;
  std::string node_name;
  Transform to_world = kIdentity;
};

/// A camera of the file put into the scene by a node.
struct PlacedCamera {
  int camera = 0;
  std::string place;  ///< of the node, for messages
  Transform to_world = kIdentity;
};

/// The meshes of the default scene (else of the first, else of all nodes without a parent), nodes
/// in depth-first order, each copy of EXT_mesh_gpu_instancing for itself. Skins and animations are
/// at rest.
/// @throws Error input: nodes that are not a tree, or a transform that is not finite.
std::vector<PlacedMesh> place_meshes(GltfFile& file);

/// The cameras of the same nodes in the same order.
/// @throws Error input, as place_meshes.
std::vector<PlacedCamera> place_cameras(const GltfFile& file);

}  // namespace leafhull
