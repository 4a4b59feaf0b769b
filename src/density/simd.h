// SPDX-License-Identifier: Apache-2.0
// Eight floats at a time, in the vector types of GCC and clang.
#pragma once

#include <bit>
#include <cstdint>

/// Put before a function, compiles a second copy for wider vectors. The copy is chosen when the
/// program is loaded, which is too early for the thread sanitizer.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define FOR_EVERY_VECTOR_WIDTH __attribute__((target_clones("default", "avx2")))
#else
#define FOR_EVERY_VECTOR_WIDTH
#endif

// Functions that take vectors are inlined, so no vector crosses a call.
#pragma GCC diagnostic ignored "-Wpsabi"
#define ALWAYS_INLINE [[gnu::always_inline]] inline

namespace leafhull {

using Floats = float __attribute__((vector_size(32)));
/// The result of a comparison: -1 in lanes where it holds, else 0.
using Ints = std::int32_t __attribute__((vector_size(32)));

ALWAYS_INLINE Floats positive(Floats a) { return a > 0.0f ? a : Floats{}; }
ALWAYS_INLINE Floats absolute(Floats a) {
  return std::bit_cast<Floats>(std::bit_cast<Ints>(a) & 0x7fffffff);
}

/// A bit for each lane in which a comparison holds.
ALWAYS_INLINE unsigned bits_of(Ints truth) {
#ifdef __SSE__
  using Half = float __attribute__((vector_size(16)));
  const auto lanes = std::bit_cast<Floats>(truth);
  const Half low = __builtin_shufflevector(lanes, lanes, 0, 1, 2, 3);
  const Half high = __builtin_shufflevector(lanes, lanes, 4, 5, 6, 7);
  return static_cast<unsigned>(__builtin_ia32_movmskps(low) | __builtin_ia32_movmskps(high) << 4);
#else
  unsigned bits = 0;
  for (unsigned i = 0; i < 8; ++i) bits |= static_cast<unsigned>(-truth[i]) << i;
  return bits;
#endif
}

}  // namespace leafhull
