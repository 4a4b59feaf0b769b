// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "leafhull/shape.h"

namespace leafhull {

inline Vec3d world_position(const Mesh& mesh, std::size_t vertex) {
  return mesh.origin + Vec3d(mesh.positions[vertex]);
}

/// The vertex's normal, of unit length to the last bit of a float, as formats demand.
/// @throws Error internal: the normal has no direction.
Vec3f unit_normal(const Mesh& mesh, std::size_t vertex);

}  // namespace leafhull
