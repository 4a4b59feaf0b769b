// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "leafhull/tree.h"

namespace leafhull {

/// The texel shown at `i`, which may lie outside an image of `size` texels.
inline std::int64_t wrapped(std::int64_t i, std::int64_t size, Wrap wrap) {
  if (wrap == Wrap::clamp) return std::clamp<std::int64_t>(i, 0, size - 1);
  const std::int64_t period = wrap == Wrap::mirror ? 2 * size : size;
  const std::int64_t phase = (i % period + period) % period;
  return phase < size ? phase : period - 1 - phase;
}

/// The pixel of an image, four bytes, that a place in texture space shows; null where the place is
/// not finite. The image is not empty.
inline const std::uint8_t* texel_at(const Image& image, const Material& material, Vec2d uv) {
  constexpr double kFar = 1e9;  // an index is still exact here
  const bool is_near = std::abs(uv.x) < kFar && std::abs(uv.y) < kFar;  // false for NaN
  if (!is_near) return nullptr;
  const auto x = wrapped(static_cast<std::int64_t>(std::floor(uv.x * image.width)), image.width,
                         material.wrap_u);
  const auto y = wrapped(static_cast<std::int64_t>(std::floor(uv.y * image.height)), image.height,
                         material.wrap_v);
  return &image.rgba[4 * static_cast<std::size_t>(y * image.width + x)];
}

}  // namespace leafhull
