// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "input/companions.h"
#include "input/tinyobj_double.h"
#include "leafhull/tree.h"

namespace leafhull {

/// The materials of an OBJ file: those of its libraries, then those that only its faces name.
struct ObjMaterials {
  std::vector<tinyobj_double::material_t> materials;
  std::map<std::string, int> by_name;
  std::size_t in_libraries = 0;  ///< the number that libraries hold

  /// Adds the materials of a library. @param warnings as in read_material_libraries.
  void add_library(std::string_view written, const std::string& name,
                   std::vector<std::string>& warnings);

  /// The index of a material. One that no library has is added, as its name alone can tell leaves.
  int find_or_add(const std::string& name);
};

/// @param obj from `obj_text`.
/// @param warnings gets a line for each library that cannot be read or contradicts itself.
ObjMaterials read_material_libraries(std::string_view obj, const Companions& companions,
                                     std::vector<std::string>& warnings);

/// Adds materials to a tree, with images for those in `used` only. Holes in the colour image are
/// holes in the material.
void add_materials(const ObjMaterials& from, const std::vector<bool>& used,
                   const Companions& companions, TreeModel& tree);

/// Maps texture coordinates of the file to those of the material's image, v down.
Vec2f image_coordinates(const tinyobj_double::material_t& material, double u, double v);

}  // namespace leafhull
