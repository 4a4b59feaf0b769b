// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "density/descent.h"

namespace leafhull {

/// Which bricks to evaluate; by default every one that a support reaches.
struct BandOptions {
  double lowest = 0;          ///< a block below the lowest T asked about is outside
  double highest = HUGE_VAL;  ///< a block that reaches the highest everywhere is inside
  int falloff = 2;            ///< k
  int margin = 1;             ///< voxels by which a block is grown before it is decided
};

/// Called with bricks to evaluate, in ascending order of their root blocks, and with the share of
/// the work that is done, 0 to 1.
using BandVisitor = std::function<void(const BrickList& bricks, double done)>;

/// Finds the bricks that a surface N = T, lowest <= T <= highest, may cross, in batches of bounded
/// size, and returns the blocks that are proven inside. The order of bricks and blocks depends on
/// the lattice alone. SPEC: 5.
std::vector<Block> find_band(const KernelSet& kernels, const BandOptions& options,
                             const BandVisitor& visit);

}  // namespace leafhull
