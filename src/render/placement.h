// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/vec.h"

namespace leafhull::render {

/// From model space to the scene's: `origin` becomes zero, lengths are multiplied by `scale`.
struct Placement {
  Vec3d origin;
  double scale = 1;
  Vec3f operator()(Vec3d p) const { return Vec3f((p - origin) * scale); }
};

}  // namespace leafhull::render
