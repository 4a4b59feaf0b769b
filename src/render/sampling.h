// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "leafhull/vec.h"

namespace leafhull::render {

inline std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x21f0aaadu;
  x = (x ^ (x >> 15)) * 0xd35a2d97u;
  return x ^ (x >> 15);
}

inline std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Owen's nested uniform scramble of a binary fraction.
inline std::uint32_t scramble(std::uint32_t x, std::uint32_t seed) {
  x = reverse_bits(x) + seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return reverse_bits(x);
}

/// Point `index` in [0, 1)^2 of a Sobol sequence shuffled and scrambled by `seed`, so that
/// sequences with different seeds are independent. Source: B. Burley, "Practical Hash-based Owen
/// Scrambling", JCGT 9(4), 2020.
inline Vec2f sobol(std::uint32_t index, std::uint32_t seed) {
  index = scramble(index, hash(seed));
  std::uint32_t second = 0;
  for (std::uint32_t i = index, v = 1u << 31; i != 0; i >>= 1, v ^= v >> 1) {
    if (i & 1) second ^= v;
  }
  const auto unit = [](std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; };
  return {unit(scramble(reverse_bits(index), hash(seed + 1))),
          unit(scramble(second, hash(seed + 2)))};
}

/// The first points of a sequence.
inline std::vector<Vec2f> sobol_points(int count, std::uint32_t seed) {
  std::vector<Vec2f> points;
  for (int i = 0; i < count; ++i) points.push_back(sobol(i, seed));
  return points;
}

/// Two unit vectors that complete the unit vector `n` to an orthonormal frame.
/// Source: T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
inline std::array<Vec3f, 2> tangents(Vec3f n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1 / (sign + n.z);
  const float b = n.x * n.y * a;
  return {Vec3f{1 + sign * n.x * n.x * a, sign * b, -sign * n.x},
          Vec3f{b, sign + n.y * n.y * a, -n.y}};
}

/// `sample` as a point of the disk of radius `radius` around the tip of `n`, orthogonal to it.
inline Vec3f on_disk(Vec3f n, Vec2f sample, float radius) {
  const auto [s, t] = tangents(n);
  const float r = radius * std::sqrt(sample.x);
  const float angle = 2 * std::numbers::pi_v<float> * sample.y;
  return n + s * (r * std::cos(angle)) + t * (r * std::sin(angle));
}

/// A unit direction around `n`, its density proportional to the cosine with `n`.
inline Vec3f cosine_direction(Vec3f n, Vec2f sample) {
  return normalized(on_disk(n, sample, 1) - n * (1 - std::sqrt(1 - sample.x)));
}

}  // namespace leafhull::render
