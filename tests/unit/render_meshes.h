// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "leafhull/shape.h"

namespace leafhull {

/// A smooth sphere of rings and segments.
inline Mesh sphere(Vec3f centre, float radius) {
  constexpr std::uint32_t kRings = 24, kSegments = 48;
  Mesh mesh;
  for (std::uint32_t i = 0; i <= kRings; ++i) {
    for (std::uint32_t j = 0; j < kSegments; ++j) {
      const float polar = std::numbers::pi_v<float> * i / kRings;
      const float around = 2 * std::numbers::pi_v<float> * j / kSegments;
      const Vec3f n{std::sin(polar) * std::sin(around), std::cos(polar),
                    std::sin(polar) * std::cos(around)};
      mesh.positions.push_back(centre + n * radius);
      mesh.normals.push_back(n);
    }
  }
  for (std::uint32_t i = 0; i < kRings; ++i) {
    for (std::uint32_t j = 0; j < kSegments; ++j) {
      const std::uint32_t a = i * kSegments + j, b = i * kSegments + (j + 1) % kSegments;
      mesh.triangles.push_back({a, a + kSegments, b + kSegments});
      mesh.triangles.push_back({a, b + kSegments, b});
    }
  }
  return mesh;
}

}  // namespace leafhull
