// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
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
  Transform to_world = kIdentity;   ///< as the file has it, finite or not
};

/// "nodes[3], EXT_mesh_gpu_instancing, copy 5"
std::string place_of(const PlacedMesh& placed);

bool is_finite(const Transform& transform);

/// The meshes that the default scene places, each once, and once more for each way it is posed.
struct GltfMeshes {
  TreeModel tree;                                        ///< without instances
  std::map<int, std::vector<std::uint32_t>> primitives;  ///< of the tree by the mesh's number, in
                                                         ///< file order; posed ones have their own
};

using MeshVisitor = std::function<void(const GltfMeshes& meshes, const PlacedMesh& placed)>;

/// Reads the meshes, then shows where they stand, one by one: millions need no memory. Nodes come
/// in depth-first order. Arguments as of read_gltf.
/// @param survey where it is given, is shown all of them first.
/// @throws Error input.
GltfMeshes read_gltf_meshes(ByteSpan bytes, const std::string& name, const Companions& companions,
                            const MeshVisitor& visit, const MeshVisitor& survey = {});

}  // namespace leafhull
