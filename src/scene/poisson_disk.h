// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "leafhull/vec.h"

namespace leafhull {

/// Random numbers that are the same with every standard library, unlike its distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// A number in [0, 1).
  double number() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double number(double low, double high) { return low + (high - low) * number(); }

  /// An index below `count`, which must be far below 2^53.
  std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(number() * static_cast<double>(count));
  }

 private:
  std::mt19937_64 engine_;
};

struct Disks {
  std::vector<Vec2d> centres;  ///< within [0, area.x) x [0, area.y)
  double distance = 0;         ///< between any two centres, at least
};

/// Exactly `count` points of a Poisson-disk pattern that fills a rectangle; their distance is about
/// 0.78 sqrt(area / count).
/// Source: Bridson, "Fast Poisson Disk Sampling in Arbitrary Dimensions", SIGGRAPH sketches, 2007.
Disks poisson_disks(Vec2d area, std::size_t count, Random& random);

}  // namespace leafhull
