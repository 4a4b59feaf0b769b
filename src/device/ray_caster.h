// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "density/brick_grid.h"
#include "density/descent.h"
#include "density/kernel_set.h"
#include "leafhull/device.h"

namespace leafhull {

/// A place and a unit direction there, voxels from the lattice's anchor, as the device reads it.
struct VoxelRay {
  Vec3f origin, direction;
};
static_assert(sizeof(VoxelRay) == 24);

/// Where a ray meets the surface.
struct VoxelHit {
  float distance;  ///< voxels; infinite if it does not meet it
  Vec3f gradient;  ///< of N, up to a positive factor
};
static_assert(sizeof(VoxelHit) == 16);

/// Casts rays at the surface N = T on a device, without polygons. Every call returns when its
/// results are there; they depend on the rays and their order alone.
class RayCaster {
 public:
  /// N comes from the kernels near each brick: `lists` has the bricks of the grid in their order.
  /// All must outlive the caster. @throws Error device, as all calls do.
  RayCaster(Device& device, const BrickGrid& grid, double threshold, const KernelSet& kernels,
            const BrickList& lists, int falloff);
  /// N comes from the samples alone.
  RayCaster(Device& device, const BrickGrid& grid, double threshold);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;

  /// The nearest crossing of N = T that is drawn, from either side, within 0.02 voxels. Rays that
  /// follow each other should be neighbours: a CPU takes sixteen together.
  void closest(std::span<const VoxelRay> rays, std::span<VoxelHit> hits);

  /// The share of light, 0..1, that is blocked along each ray of length `reach` voxels: the highest
  /// saturate((N - T) / soft), with N taken from the samples. A `soft` near 0 gives shadows, a
  /// `soft` of T ambient occlusion.
  void blocked(std::span<const VoxelRay> rays, float soft, float reach, std::span<float> blocked);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace leafhull
