// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "leafhull/vec.h"

namespace leafhull {

/// The v, vn and vt lines of an OBJ file.
struct ObjVertices {
  std::vector<Vec3d> positions;
  std::vector<Vec3f> colors;   ///< linear, of all positions, or none
  std::vector<Vec3f> normals;  ///< NaN where a line is not three numbers
  std::vector<Vec2d> uvs;      ///< NaN where a line is not one or two numbers
};

/// Reads them from `obj_text`; tinyobjloader would read anything that is not a number as zero.
/// @param warnings gets a line for values that are not finite, and one for elements that are no
/// faces.
/// @throws Error input: a v line is not three finite numbers.
ObjVertices read_obj_vertices(std::string_view text, const std::string& file,
                              std::vector<std::string>& warnings);

}  // namespace leafhull
