// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/gltf_file.h"
#include "input/gltf_materials.h"
#include "input/gltf_pose.h"
#include "leafhull/tree.h"

namespace leafhull {

/// The triangles of one primitive of a mesh, without unused vertices. None, with a warning, if it
/// holds no triangles.
/// @throws Error input.
std::optional<Primitive> read_primitive(GltfFile& file, std::size_t mesh, std::size_t primitive,
                                        MaterialReader& materials, const GltfPose& pose,
                                        std::vector<std::string>& warnings);

}  // namespace leafhull
