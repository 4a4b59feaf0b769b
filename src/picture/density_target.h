// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "pipeline/direct_surface.h"
#include "render/surface.h"
#include "render/target.h"

namespace leafhull {

/// The surface N = T as a target for rays of a scene, and how open the places around it are.
class DensityTarget final : public render::Target, public render::Surroundings {
 public:
  /// @param color of the foliage, linear.
  DensityTarget(std::shared_ptr<const DirectSurface> surface, const render::Placement& placement,
                Vec3f color);

  void closest(std::span<const render::Ray> rays, std::span<render::Spot> spots) const override;
  void occluded(std::span<const render::Ray> rays, float reach,
                std::span<std::uint8_t> answers) const override;
  /// Works for any surface in the scene: ambient occlusion is the highest saturate((N - T) / T) on
  /// the way to the sky.
  void openness(std::span<const render::Spot> spots, std::span<const std::uint8_t> turns,
                std::span<float> open) const override;

 private:
  float threshold() const;
  VoxelRay in_voxels(Vec3f position, Vec3f direction) const;
  std::vector<VoxelRay> in_voxels(std::span<const render::Ray> rays) const;

  std::shared_ptr<const DirectSurface> surface_;
  Vec3d origin_;   ///< the scene's, voxels from the lattice's anchor
  double voxels_;  ///< per unit of the scene
  Vec3f color_;
};

}  // namespace leafhull
