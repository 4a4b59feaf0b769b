// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render/scene.h"
#include "render/target.h"

namespace leafhull::render {

/// The triangles of a scene: wood in its own colour, shapes in one green, leaves as foliage.
class MeshTarget : public Target {
 public:
  /// `scene` must outlive it.
  explicit MeshTarget(const Scene& scene) : scene_(scene) {}

  void closest(std::span<const Ray> rays, std::span<Spot> spots) const override;
  void occluded(std::span<const Ray> rays, float reach,
                std::span<std::uint8_t> answers) const override;

 private:
  const Scene& scene_;
};

/// The sky sampled by single rays: a sample is 1 if a ray meets no target within kSkyReach.
class MeshSurroundings : public Surroundings {
 public:
  /// The targets must outlive it.
  explicit MeshSurroundings(std::span<const Target* const> targets)
      : targets_(targets.begin(), targets.end()) {}

  void openness(std::span<const Spot> spots, std::span<const std::uint8_t> turns,
                std::span<float> open) const override;

 private:
  std::vector<const Target*> targets_;
};

/// 1 where any of the targets lies within `reach` along a ray, else 0.
std::vector<std::uint8_t> occluded(std::span<const Target* const> targets,
                                   std::span<const Ray> rays, float reach);

}  // namespace leafhull::render
