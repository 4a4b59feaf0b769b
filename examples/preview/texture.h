// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/tree.h"

namespace leafhull::preview {

/// The linear base colour of a material at `uv`: its image, bilinear and wrapped, times its factor.
Vec3f base_color(const TreeModel& model, const Material& material, Vec2f uv);

/// Its alpha there, 0..1.
float alpha(const TreeModel& model, const Material& material, Vec2f uv);

}  // namespace leafhull::preview
