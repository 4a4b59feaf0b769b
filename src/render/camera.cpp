// SPDX-License-Identifier: Apache-2.0
#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace leafhull::render {
namespace {

constexpr float kRadian = std::numbers::pi_v<float> / 180;
constexpr float kAzimuth = 32 * kRadian, kElevation = 9 * kRadian;
constexpr float kTanHalfView = 0.11f;  // of the picture's longer side

/// The frustum planes on both sides of one picture axis, pushed outward until they touch the
/// points.
struct Wedge {
  float slope;
  float low = -HUGE_VALF, high = -HUGE_VALF;

  void include(float across, float depth, float reach) {
    const float beyond = reach * std::hypot(1.0f, slope) - slope * depth;
    low = std::max(low, beyond - across);
    high = std::max(high, beyond + across);
  }
  float centre() const { return (high - low) / 2; }
  float depth() const { return -(high + low) / (2 * slope); }
};

}  // namespace

Camera frame(std::span<const Vec3f> points, float aspect, float margin, float reach) {
  const float longer = std::max(aspect, 1.0f);
  Camera camera;
  camera.tan_x = kTanHalfView * aspect / longer;
  camera.tan_y = kTanHalfView / longer;
  camera.forward = {-std::cos(kElevation) * std::sin(kAzimuth), -std::sin(kElevation),
                    -std::cos(kElevation) * std::cos(kAzimuth)};
  camera.right = normalized(cross(camera.forward, Vec3f{0, 1, 0}));
  camera.up = cross(camera.right, camera.forward);

  Wedge horizontal{camera.tan_x * (1 - 2 * margin)}, vertical{camera.tan_y * (1 - 2 * margin)};
  for (const Vec3f p : points) {
    const float depth = dot(p, camera.forward);
    horizontal.include(dot(p, camera.right), depth, reach);
    vertical.include(dot(p, camera.up), depth, reach);
  }
  camera.eye = camera.right * horizontal.centre() + camera.up * vertical.centre() +
               camera.forward * std::min(horizontal.depth(), vertical.depth());
  return camera;
}

}  // namespace leafhull::render
