// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "leafhull/vec.h"
#include "scene/random.h"

namespace leafhull {

struct Disks {
  std::vector<Vec2d> centres;  ///< within [0, area.x) x [0, area.y)
  double distance = 0;         ///< between any two centres, at least
};

/// Exactly `count` points of a Poisson-disk pattern that fills a rectangle; their distance is about
/// 0.78 sqrt(area / count).
/// Source: Bridson, "Fast Poisson Disk Sampling in Arbitrary Dimensions", SIGGRAPH sketches, 2007.
Disks poisson_disks(Vec2d area, std::size_t count, Random& random);

}  // namespace leafhull
