// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "density/lattice.h"
#include "leafhull/shape.h"

namespace leafhull {

/// The spatial hash of kernel centres, an OpenVDB point index grid whose cell is the largest
/// radius.
class KernelHash {
 public:
  /// `kernels` must outlive the hash; at most 2^32 - 1 of them.
  KernelHash(std::span<const Kernel> kernels, const Lattice& lattice);
  ~KernelHash();
  KernelHash(KernelHash&&) noexcept;

  std::span<const Kernel> kernels() const { return kernels_; }
  const Lattice& lattice() const { return lattice_; }

  /// Replaces `found` by the kernels whose centre is within the largest radius of the box
  /// [low, high] (local, voxels) along every axis, in ascending order. Thread-safe.
  void gather(Vec3d low, Vec3d high, std::vector<std::uint32_t>& found) const;

  /// The origins of the root blocks that a support reaches when grown by `margin` voxels,
  /// ascending.
  std::vector<Coord> root_blocks(double margin) const;

 private:
  struct Grid;
  std::span<const Kernel> kernels_;
  Lattice lattice_;
  double reach_ = 0;  // largest radius, voxels
  double cell_ = 0;   // of the hash, voxels
  std::unique_ptr<Grid> grid_;
};

}  // namespace leafhull
