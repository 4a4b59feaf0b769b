// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>

#include "leafhull/vec.h"

namespace leafhull {

/// The data of a mesh that a file states before the vertices, for meshes that are streamed because
/// they are larger than memory.
struct MeshHead {
  std::uint64_t vertices = 0, triangles = 0;
  Vec3d origin;
  Box box;                      ///< of the positions, from the origin
  std::optional<Vec3f> colour;  ///< its material's, linear; none: the green of leaves
};

/// Writes the head of a PLY file. The vertices follow, position and normal, then the triangles,
/// each with a byte 3 before its 32-bit indices.
/// @param far_out whether positions are `double`, else `float`.
void write_ply_head(std::uint64_t vertices, std::uint64_t triangles, bool far_out,
                    std::ostream& stream);

/// Writes the head of a GLB with the same scene as write_glb's. The vertices follow, position and
/// normal as floats, then the triangles as 32-bit indices.
/// @throws Error output: it does not fit into the 4 GiB of a GLB.
void write_glb_head(const MeshHead& mesh, std::ostream& stream);

}  // namespace leafhull
