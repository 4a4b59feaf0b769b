// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "leafhull/device.h"
#include "leafhull/forest.h"
#include "leafhull/leaves.h"
#include "leafhull/scene.h"
#include "runs/sealed_json.h"

namespace leafhull {

/// All that the bytes of a forest depend on: the scene and its leaves by a checksum, the options,
/// the version and the device.
/// @param voxel_size of level 0; `edge`: cells along a tile. 0: there are no tiles.
Json forest_identity(const Scene& scene, std::span<const LeafSet> models,
                     const ForestOptions& options, const DeviceInfo& device, double voxel_size,
                     int edge);

}  // namespace leafhull
