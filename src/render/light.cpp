// SPDX-License-Identifier: Apache-2.0
#include "render/light.h"

#include <cmath>

#include "colour/colour.h"

namespace leafhull::render {
namespace {

constexpr double kLitLightness = 0.66;  // in Oklab
constexpr double kLitChroma = 0.8;      // share of the leaves' chroma: the sun adds to it

}  // namespace

Vec3f sun_direction(const Camera& camera) {
  const Vec3f towards_eye = cross(camera.right, Vec3f{0, 1, 0});
  return normalized(camera.right * -0.75f + Vec3f{0, 1.1f, 0} + towards_eye * 0.4f);
}

Vec3f develop(Vec3f radiance) {
  const auto shoulder = [](float x) { return x < 0.5f ? x : 1 - 0.25f / x; };
  return {shoulder(radiance.x), shoulder(radiance.y), shoulder(radiance.z)};
}

Vec3f foliage_colour(const std::optional<Vec3f>& leaves) {
  const Vec3d lab = oklab_of(leaves ? *leaves : kLeafGreen);
  return shown_oklab({(lab.x + kLitLightness) / 2, kLitChroma * lab.y, kLitChroma * lab.z});
}

std::uint8_t srgb(float linear) {
  return static_cast<std::uint8_t>(std::lround(255 * srgb_of_linear(linear)));
}

}  // namespace leafhull::render
