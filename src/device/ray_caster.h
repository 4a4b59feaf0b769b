// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
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
  float distance;  ///< voxels; infinite where it does not
  Vec3f gradient;  ///< of N, up to a positive factor
};
static_assert(sizeof(VoxelHit) == 16);

/// Rays against the surface N = T on a device, no polygons. Every call returns when its results are
/// there; results depend on the rays and their order alone.
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

  /// How much of a light each ray of length `reach` voxels does not get, 0..1: the highest of
  /// saturate((N - T) / soft) along it, N taken from the samples. A `soft` near 0 makes shadows; T
  /// ambient occlusion.
  void blocked(std::span<const VoxelRay> rays, float soft, float reach, std::span<float> blocked);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace leafhull
