// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/tree.h"

namespace leafhull::render {

/// The linear base colour of a material at `uv`: `image`, bilinear and wrapped, if there
/// is one, times its factor.
Vec3f base_color(const Material& material, const Image* image, Vec2f uv);

/// The alpha of a material at `uv`, 0..1.
float alpha(const Material& material, const Image* image, Vec2f uv);

}  // namespace leafhull::render
