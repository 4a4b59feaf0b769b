// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "density/lattice.h"
#include "leafhull/shape.h"

namespace leafhull {

/// The spatial hash of kernel centres, made by OpenVDB's point partitioner. It ranks the kernels:
/// by cell, then by index. N is summed in the order of ranks, so a sum does not depend on who asks
/// for it.
class SpatialHash {
 public:
  /// `cells`: a lattice whose voxels are the hash's cells, anchored near the kernels; cells of the
  /// size of a support suit. At most 2^32 - 1 kernels.
  SpatialHash(std::span<const Kernel> kernels, const Lattice& cells);
  /// Takes centres only, model units.
  SpatialHash(std::span<const Vec3d> centres, const Lattice& cells);
  ~SpatialHash();
  SpatialHash(SpatialHash&&) noexcept;

  /// The kernel of each rank.
  std::span<const std::uint32_t> order() const { return order_; }

  /// Replaces `ranks` by those of all kernels with a centre in the box [low, high] (model units),
  /// and of some beyond it, ascending. Thread-safe.
  void gather(Vec3d low, Vec3d high, std::vector<std::uint32_t>& ranks) const;

  /// The occupied cells as boxes in model units, in the order of ranks.
  std::vector<Box> occupied() const;

  const Lattice& cells() const { return cells_; }

 private:
  struct Node;
  Lattice cells_;
  std::vector<Node> nodes_;  // 8 x 8 x 8 cells each, ascending
  std::vector<std::uint32_t> order_;
};

}  // namespace leafhull
