// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "input/file_bytes.h"
#include "leafhull/tree.h"

namespace leafhull {

/// Reads Wavefront OBJ with its material libraries. Every object or group is a mesh and a node of
/// its name, with one primitive per material; polygons become triangles.
/// @param path as messages call the file; material libraries and textures lie beside it.
/// @throws Error input.
TreeModel read_obj(ByteSpan bytes, const std::filesystem::path& path);

}  // namespace leafhull
