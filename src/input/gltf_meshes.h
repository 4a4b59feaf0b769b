// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "input/companions.h"
#include "input/file_bytes.h"
#include "leafhull/tree.h"

namespace leafhull {

/// A mesh of the file put into the scene by a node.
struct PlacedMesh {
  int mesh = 0;  ///< its number in GltfMeshes::primitives
  int node = 0;
  const std::string& node_name;
  std::optional<std::size_t> copy;  ///< of EXT_mesh_gpu_instancing
  Transform to_world = kIdentity;   ///< as in the file; may not be finite
};

/// "nodes[3], EXT_mesh_gpu_instancing, copy 5"
std::string place_of(const PlacedMesh& placed);

bool is_finite(const Transform& transform);

/// The meshes that the default scene places, each once, and again for each pose.
struct GltfMeshes {
  TreeModel tree;                                        ///< without instances
  std::map<int, std::vector<std::uint32_t>> primitives;  ///< of the tree by the mesh's number, in
                                                         ///< file order; posed ones have their own
};

using MeshVisitor = std::function<void(const GltfMeshes& meshes, const PlacedMesh& placed)>;

/// Reads the meshes, then calls a function with each place, so that millions of places need no
/// memory. Nodes come in depth-first order. Arguments are as in read_gltf.
/// @param survey if given, is called with all places first.
/// @throws Error input.
GltfMeshes read_gltf_meshes(ByteSpan bytes, const std::string& name, const Companions& companions,
                            const MeshVisitor& visit, const MeshVisitor& survey = {});

}  // namespace leafhull
