// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "leafhull/tree.h"

namespace leafhull {

/// The place of something in a world whose y is up, of its place in one whose z is.
inline Transform z_up_to_y_up(Transform to_world) {
  auto& [x, y, z] = to_world;
  std::swap(y, z);
  for (double& entry : z) entry = -entry;
  return to_world;
}

}  // namespace leafhull
