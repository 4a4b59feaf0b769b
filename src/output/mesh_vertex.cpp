// SPDX-License-Identifier: Apache-2.0
#include "output/mesh_vertex.h"

#include <cmath>
#include <string>

#include "leafhull/error.h"

namespace leafhull {

Vec3f unit_normal(const Mesh& mesh, std::size_t vertex) {
  const Vec3d normal(mesh.normals[vertex]);
  const double norm = length(normal);
  if (!(norm > 0) || !std::isfinite(norm)) {
    throw Error(ErrorCode::internal,
                "the normal of mesh vertex " + std::to_string(vertex) + " has no direction",
                "Please report this with the tree and the command.");
  }
  return Vec3f(normal / norm);
}

}  // namespace leafhull
