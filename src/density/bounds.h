// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "density/local_kernel.h"

namespace leafhull {

struct Interval {
  float low, high;
};

/// Bounds on xi over the cube with centre `from_kernel` (relative to the kernel's centre, voxels)
/// and half extent `half`: with m_a = |a.(q - c)| and e_a = half * sum |a_i| for each axis a, sum
/// max(0, m_a - e_a)^2 <= xi <= sum (m_a + e_a)^2. SPEC: 5.
inline Interval xi_bounds(const std::array<Vec3f, 3>& axes, Vec3f from_kernel, float half) {
  Interval xi{0, 0};
  for (const Vec3f& a : axes) {
    const float m = std::fabs(dot(a, from_kernel));
    const float e = half * (std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z));
    const float near = std::max(0.0f, m - e);
    const float far = m + e;
    xi.low += near * near;
    xi.high += far * far;
  }
  return xi;
}

/// D as a function of xi, k = 1, 2 or 3. Source: Eqs. (1), (4).
inline float falloff_of(float xi, int k) {
  const float w = std::max(0.0f, 1.0f - xi);
  return k == 1 ? w : k == 2 ? w * w : w * w * w;
}

}  // namespace leafhull
