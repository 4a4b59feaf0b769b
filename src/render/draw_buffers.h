// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "render/buffers.h"
#include "render/camera.h"
#include "render/target.h"

namespace leafhull::render {

struct Effort {
  int edge_rays = 8;  ///< per edge pixel, besides the one through its centre
  int shares = 2;     ///< how often neighbours share their light: less noise, softer shadows
};

/// What each pixel of a picture of `targets` sees, and the light of the key light and the sky
/// there. Among equally near hits, the first target wins.
/// @param tell is called from this thread with the share that is done, rising to 1.
Buffers draw_buffers(std::span<const Target* const> targets, const Surroundings& surroundings,
                     const Camera& camera, int width, int height, Effort effort = {},
                     const std::function<void(double)>& tell = {});

}  // namespace leafhull::render
