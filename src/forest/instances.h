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

/// A GLB with each shape once and a node per model that places it by EXT_mesh_gpu_instancing.
/// Trees whose map is no rotation and scale (sheared ones) become nodes with a matrix of their
/// own, as do those that mirror.
/// @throws Error output: it does not fit into a GLB.
void write_instances(std::span<const ModelShape> shapes, std::span<const PlacedTree> trees,
                     std::ostream& stream);

}  // namespace leafhull
