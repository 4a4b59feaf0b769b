// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ufbx.h>

#include <optional>
#include <string>

#include "leafhull/tree.h"

namespace leafhull {

/// The faces of a mesh in one material slot, as posed triangles; none if there are none. The
/// material is not set.
/// @param colour the texture whose coordinates are read, or null.
/// @throws Error input: a position is not finite.
std::optional<Primitive> read_fbx_part(const ufbx_mesh& mesh, const ufbx_mesh_part& part,
                                       const ufbx_texture* colour, const std::string& file);

}  // namespace leafhull
