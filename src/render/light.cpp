// SPDX-License-Identifier: Apache-2.0
#include "render/light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace leafhull::render {
namespace {

/// IEC 61966-2-1, decoded.
const std::array<float, 256> kLinear = [] {
  std::array<float, 256> table;
  for (int i = 0; i < 256; ++i) {
    const float s = i / 255.0f;
    table[i] = s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
  }
  return table;
}();

}  // namespace

Vec3f sun_direction(const Camera& camera) {
  const Vec3f towards_eye = cross(camera.right, Vec3f{0, 1, 0});
  return normalized(camera.right * -0.75f + Vec3f{0, 1.1f, 0} + towards_eye * 0.4f);
}

Vec3f sky(Vec3f direction) {
  return direction.y < 0 ? kPaperBounce : mix(kHorizon, kZenith, std::sqrt(direction.y));
}

Vec3f develop(Vec3f radiance) {
  const auto shoulder = [](float x) { return x < 0.5f ? x : 1 - 0.25f / x; };
  return {shoulder(radiance.x), shoulder(radiance.y), shoulder(radiance.z)};
}

float linear(std::uint8_t srgb) { return kLinear[srgb]; }

std::uint8_t srgb(float linear) {
  if (linear >= 1) return 255;
  const float x = std::max(linear, 0.0f);
  const float s = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

}  // namespace leafhull::render
