// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "render/buffers.h"
#include "render/camera.h"
#include "render/target.h"

namespace leafhull::render {

struct Effort {
  int edge_rays = 8;  ///< where surfaces end, beside the one through the pixel's centre
  int shares = 2;     ///< how often neighbours share their light: less noise, softer shadows
};

/// What each pixel of a picture of `targets`, the nearest first in front, sees, and the light of
/// the key light and of the sky there.
/// @param tell is called from this thread with the share that is done, rising to 1.
Buffers draw_buffers(std::span<const Target* const> targets, const Surroundings& surroundings,
                     const Camera& camera, int width, int height, Effort effort = {},
                     const std::function<void(double)>& tell = {});

}  // namespace leafhull::render
