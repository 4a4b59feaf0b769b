// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "density/simd.h"

namespace leafhull {

// How a density function falls off: D = w^k, where w = max(0, top - |U d|^2) and top =
// weight^(1/k). The kernels' side of it is kernels/falloff.clh. SPEC: 2; Source: Eqs. (1), (4).

/// The largest exponent k; the least is 1.
inline constexpr int kLargestFalloff = 3;

/// w^k, for numbers and for vectors of them.
template <class Number>
ALWAYS_INLINE Number falloff_power(Number w, int k) {
  return k == 1 ? w : k == 2 ? w * w : w * w * w;
}

/// weight^(1/k)
inline float falloff_root(float weight, int k) {
  return k == 1 ? weight : k == 2 ? std::sqrt(weight) : std::cbrt(weight);
}

}  // namespace leafhull
