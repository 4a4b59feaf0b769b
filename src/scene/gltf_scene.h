// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "leafhull/scene.h"

namespace leafhull {

/// Every mesh with leaves is a model and every node that holds it a tree.
/// @throws Error input.
Scene read_gltf_scene(const std::filesystem::path& file, const LeafOptions& leaves,
                      const ReadOptions& reading);

}  // namespace leafhull
