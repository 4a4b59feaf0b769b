// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "density/descent.h"

namespace leafhull {

/// Which bricks to evaluate.
struct BandOptions {
  /// The values of T, ascending; none: every brick that a support reaches is found.
  std::vector<double> thresholds = {};
  int falloff = 2;  ///< k
  int margin = 1;   ///< voxels by which a block is grown before it is decided
  /// Blocks outside this box are skipped.
  std::optional<SampleBox> range = {};
};

/// Called with bricks to evaluate, in ascending order of their root blocks, and with the share of
/// the work that is done, 0 to 1.
using BandVisitor = std::function<void(const BrickList& bricks, double done)>;

/// Finds the bricks that one of the surfaces N = T may cross, in batches of bounded size, and
/// returns the blocks that are proven inside, each with the highest T for which this holds. The
/// order of bricks and blocks depends on the lattice alone. SPEC: 5.
std::vector<InsideBlock> find_band(const KernelSet& kernels, const BandOptions& options,
                                   const BandVisitor& visit);

}  // namespace leafhull
