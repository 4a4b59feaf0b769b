// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "leafhull/vec.h"
#include "render/buffers.h"

namespace leafhull::render {

/// A ray in the scene.
struct Ray {
  Vec3f origin, direction;  ///< direction: unit
};

/// The nearest surface along a ray.
struct Spot {
  float distance = HUGE_VALF;  ///< infinite where there is none
  Object object = Object::paper;
  Vec3f start;        ///< where rays to the light start: just off the surface
  Vec3f normal;       ///< unit, smooth, on the ray's side
  Vec3f face_normal;  ///< unit, of the surface itself; rays below it are hidden
  Vec3f color;        ///< linear
  bool hit() const { return object != Object::paper; }
};

/// Surfaces that rays are cast against, many rays at a time. Rays that follow each other should be
/// neighbours. Results depend on the rays and their order alone.
class Target {
 public:
  Target() = default;
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;
  virtual ~Target() = default;

  /// The nearest surface along each ray.
  virtual void closest(std::span<const Ray> rays, std::span<Spot> spots) const = 0;
  /// Answers 1 for a ray that meets anything within `reach`, else 0.
  virtual void occluded(std::span<const Ray> rays, float reach,
                        std::span<std::uint8_t> answers) const = 0;
};

/// Tells how open the places around surfaces are to the sky.
class Surroundings {
 public:
  Surroundings() = default;
  Surroundings(const Surroundings&) = delete;
  Surroundings& operator=(const Surroundings&) = delete;
  virtual ~Surroundings() = default;

  /// The share of the sky's light that arrives at each spot, 0..1, or a sample of it, which callers
  /// average over neighbours. `turns` (0 to kTurns - 1) select the sample; spots without a surface
  /// may be skipped.
  virtual void openness(std::span<const Spot> spots, std::span<const std::uint8_t> turns,
                        std::span<float> open) const = 0;
  static constexpr int kTurns = 16;
};

}  // namespace leafhull::render
