// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <vector>

#include "input/gltf_file.h"
#include "leafhull/tree.h"

namespace leafhull {

/// How a node uses a mesh: as it is, with its targets mixed in, or posed by a skin's joints.
struct MeshUse {
  int mesh = 0;
  int skin = -1;                ///< -1: none
  std::vector<double> weights;  ///< of the morph targets; none: all zero
  auto operator<=>(const MeshUse&) const = default;

  bool is_plain() const { return skin < 0 && weights.empty(); }
};

/// @throws Error input: there is no such mesh or skin.
MeshUse use_of(const GltfFile& file, int node);

/// What moves the vertices of a mesh.
struct GltfPose {
  std::vector<Transform> joints;  ///< from the mesh's bind pose into the world
  std::vector<double> weights;    ///< of the morph targets
};

/// @param to_world of every node of the file.
/// @throws Error input: a joint that is no node, or matrices that are not one a joint.
GltfPose pose_of(GltfFile& file, const MeshUse& use, const std::vector<Transform>& to_world);

/// Moves the vertices of a primitive. Call it before unused vertices are dropped.
/// @throws Error input: attributes that do not fit.
void pose_primitive(GltfFile& file, const tinygltf::Primitive& source, const GltfPose& pose,
                    const std::string& place, Primitive& primitive);

}  // namespace leafhull
