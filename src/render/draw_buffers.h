// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "render/buffers.h"
#include "render/camera.h"
#include "render/target.h"

namespace leafhull::render {

/// What each pixel of a picture of `targets`, the nearest first in front, sees, and the light of
/// the key light and of the sky there.
/// @param edge_rays beside the one through the centre of a pixel where surfaces end
Buffers draw_buffers(std::span<const Target* const> targets, const Surroundings& surroundings,
                     const Camera& camera, int width, int height, int edge_rays = 8);

}  // namespace leafhull::render
