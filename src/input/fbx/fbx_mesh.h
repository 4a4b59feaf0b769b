// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ufbx.h>

#include <optional>
#include <string>

#include "leafhull/tree.h"

namespace leafhull {

/// The faces of a mesh that have the material of one of its slots, as triangles, posed; nothing
/// where there are none. Its material is not set.
/// @param colour the texture whose coordinates are read, or null.
/// @throws Error input: a position is not finite.
std::optional<Primitive> read_fbx_part(const ufbx_mesh& mesh, const ufbx_mesh_part& part,
                                       const ufbx_texture* colour, const std::string& file);

}  // namespace leafhull
