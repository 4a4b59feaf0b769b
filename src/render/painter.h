// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/picture.h"
#include "render/camera.h"
#include "render/scene.h"

namespace leafhull::render {

/// Draws `scene` on white paper into the columns [left, left + width) of `picture`, its rows in
/// parallel. The ground is y = 0 and the scene stands around the origin.
/// @param samples rays per pixel, each followed by rays to the sun and to the sky
void draw(const Scene& scene, const Camera& camera, int samples, int left, int width,
          Picture& picture);

}  // namespace leafhull::render
