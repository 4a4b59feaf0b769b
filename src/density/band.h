// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "density/descent.h"

namespace leafhull {

struct BandOptions {
  std::optional<double>
      threshold;       ///< T; empty: every brick that a support reaches, as `dense` does
  int falloff = 2;     ///< k
  int margin = 1;      ///< voxels by which a brick is grown before it is decided
  bool dense = false;  ///< leave no brick undecided, evaluate all
};

/// Called with bricks to evaluate, in ascending order of their root blocks, and with the share of
/// the work that is done, 0 to 1.
using BandVisitor = std::function<void(const BrickList& bricks, double done)>;

/// Finds the bricks that the surface N = T may cross, in batches of bounded size, and returns the
/// blocks that are proven inside. The order of bricks and blocks depends on the lattice alone.
/// SPEC: 5.
std::vector<Block> find_band(const KernelHash& hash, const BandOptions& options,
                             const BandVisitor& visit);

}  // namespace leafhull
