// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <span>
#include <string>

#include "leafhull/scene.h"
#include "leafhull/shape.h"

namespace leafhull {

/// A model's abstract shape.
struct ModelShape {
  std::string name;
  Mesh mesh;  ///< without vertices: its trees are left out
};

/// A GLB with each shape once and nodes of its name that place it by EXT_mesh_gpu_instancing: one
/// per model, or more where a forest is so wide that floats would move a tree by more than
/// 1/100,000 of its size; then each places the trees near it. Trees keep their order within a node.
/// Trees that mirror get nodes of their own, since viewers turn faces around by node and not by
/// instance; so do trees that shear: a rotation and a scale, with a rotation within.
/// @throws Error output: it does not fit into a GLB.
void write_instances(std::span<const ModelShape> shapes, std::span<const PlacedTree> trees,
                     std::ostream& stream);

}  // namespace leafhull
