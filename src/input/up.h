// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "leafhull/tree.h"

namespace leafhull {

/// Converts a transform into a world whose z is up to one into a world whose y is up.
inline Transform z_up_to_y_up(Transform to_world) {
  auto& [x, y, z] = to_world;
  std::swap(y, z);
  for (double& entry : z) entry = -entry;
  return to_world;
}

}  // namespace leafhull
