// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "leafhull/leaves.h"
#include "leafhull/options.h"
#include "leafhull/scene.h"

namespace leafhull {

/// Where a tree's density may be needed: within reach of a tile's samples and the brick around
/// them. `bounds` holds its model's kernel centres; `reach` is the model's largest radius.
Box reached_box(const PlacedTree& tree, const Box& bounds, double reach, double voxel_size);

/// Checks the number of tiles before anything is computed from the models' leaves.
/// @param edge cells along a tile.
/// @throws Error usage: voxels so small that there are more tiles than the file system of `folder`
///         can hold, or more voxels than leafhull can count.
void check_tile_count(const Scene& scene, std::span<const LeafSet> models,
                      std::span<const Options> shapes, double voxel_size, int edge,
                      const std::filesystem::path& folder);

/// @throws Error usage, as above.
void check_room_for_tiles(double tiles, double voxel_size, const std::filesystem::path& folder);

}  // namespace leafhull
