// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "density/local_kernel.h"
#include "density/spatial_hash.h"

namespace leafhull {

/// A kernel set on a lattice, in the order of its spatial hash. Kernels are named by rank.
class KernelSet {
 public:
  /// No kernels.
  KernelSet() = default;
  /// `hash` is over the centres of `kernels`; they are summed with k = `falloff`.
  KernelSet(std::span<const Kernel> kernels, std::shared_ptr<const SpatialHash> hash,
            const Lattice& lattice, int falloff);
  /// Takes kernels that are on the lattice already, by rank in `hash`; none has a radius above
  /// `reach` voxels. radii() stays empty.
  KernelSet(std::vector<LatticeKernel> kernels, std::shared_ptr<const SpatialHash> hash,
            const Lattice& lattice, double reach);

  const Lattice& lattice() const { return lattice_; }
  const SpatialHash& hash() const { return *hash_; }
  /// The kernels by rank.
  std::span<const LatticeKernel> kernels() const { return kernels_; }
  /// The largest radius of all kernels, voxels.
  double reach() const { return reach_; }
  /// The largest radius of each kernel, voxels, by rank.
  std::span<const float> radii() const { return radii_; }

  /// Replaces `ranks` by those of all kernels whose centre is within reach of the box [low, high]
  /// (voxels from the anchor) along every axis, and of some beyond it, ascending. Thread-safe.
  void gather(Vec3d low, Vec3d high, std::vector<std::uint32_t>& ranks) const;

  /// The origins of the root blocks that a support reaches when grown by `margin` voxels,
  /// ascending.
  std::vector<Coord> root_blocks(double margin) const;

 private:
  std::shared_ptr<const SpatialHash> hash_;
  Lattice lattice_;
  std::vector<LatticeKernel> kernels_;
  std::vector<float> radii_;
  double reach_ = 0;
};

}  // namespace leafhull
