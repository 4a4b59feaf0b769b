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

/// The meshes of the default scene (else of the first, else of all nodes without a parent), nodes
/// in depth-first order, each copy of EXT_mesh_gpu_instancing for itself. Skins and animations are
/// at rest.
/// @throws Error input: nodes that are not a tree, or a transform that is not finite.
std::vector<PlacedMesh> place_meshes(GltfFile& file);

}  // namespace leafhull
