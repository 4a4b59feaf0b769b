// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "input/companions.h"
#include "input/file_bytes.h"
#include "input/obj_materials.h"
#include "leafhull/tree.h"

namespace leafhull {

/// Reads Wavefront OBJ with its material libraries. Every object or group is a mesh and a node of
/// its name, with one primitive per material; polygons become triangles.
/// @param file the file's name in messages; @param companions material libraries and textures.
/// @throws Error input.
TreeModel read_obj(ByteSpan bytes, const std::string& file, const Companions& companions);

/// As read_obj, from `obj_text`, with the materials of its libraries.
TreeModel read_obj_text(std::string text, const std::string& file, ObjMaterials materials,
                        const Companions& companions);

}  // namespace leafhull
