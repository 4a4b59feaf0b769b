// SPDX-License-Identifier: Apache-2.0
#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "leafhull/error.h"

namespace leafhull::render {
namespace {

constexpr double kRadian = std::numbers::pi / 180;
constexpr float kTanHalfView = 0.11f;  // along the picture's longer side

/// A frustum plane, pushed outwards until everything in the picture lies behind it.
struct Plane {
  Vec3f normal;  ///< outward, not normalised
  float offset = -HUGE_VALF;

  void include(Vec3f centre, float reach) {
    offset = std::max(offset, dot(normal, centre) + reach * length(normal));
  }
  /// Includes a ball that circles a vertical axis at `radius`.
  void include_turning(Vec3f centre, float radius, float reach) {
    const float towards = radius * std::hypot(normal.x, normal.z);
    offset = std::max(offset, dot(normal, centre) + towards + reach * length(normal));
  }
};

/// The planes on both sides of one picture axis.
struct Wedge {
  float slope;
  Plane low, high;

  Wedge(Vec3f across, Vec3f forward, float slope)
      : slope(slope), low{-across - forward * slope}, high{across - forward * slope} {}
  float centre() const { return (high.offset - low.offset) / 2; }
  float depth() const { return -(high.offset + low.offset) / (2 * slope); }
};

Camera towards(Viewpoint viewpoint, float aspect, float tan_half_view) {
  const auto azimuth = static_cast<float>(viewpoint.azimuth * kRadian);
  const auto elevation = static_cast<float>(viewpoint.elevation * kRadian);
  const float longer = std::max(aspect, 1.0f);
  Camera camera;
  camera.tan_x = tan_half_view * aspect / longer;
  camera.tan_y = tan_half_view / longer;
  camera.forward = {-std::cos(elevation) * std::sin(azimuth), -std::sin(elevation),
                    -std::cos(elevation) * std::cos(azimuth)};
  camera.right = {std::cos(azimuth), 0, -std::sin(azimuth)};
  camera.up = cross(camera.right, camera.forward);
  return camera;
}

/// `include(plane)` must include everything that the picture holds in each plane.
template <class Function>
Camera framing(float aspect, float margin, Viewpoint viewpoint, Function&& include) {
  Camera camera = towards(viewpoint, aspect, kTanHalfView);
  Wedge horizontal(camera.right, camera.forward, camera.tan_x * (1 - 2 * margin));
  Wedge vertical(camera.up, camera.forward, camera.tan_y * (1 - 2 * margin));
  for (Plane* plane : {&horizontal.low, &horizontal.high, &vertical.low, &vertical.high}) {
    include(*plane);
  }
  camera.eye = camera.right * horizontal.centre() + camera.up * vertical.centre() +
               camera.forward * std::min(horizontal.depth(), vertical.depth());
  return camera;
}

}  // namespace

Camera frame(std::span<const Vec3f> points, float aspect, float margin, float reach,
             Viewpoint viewpoint) {
  return framing(aspect, margin, viewpoint, [&](Plane& plane) {
    for (const Vec3f p : points) plane.include(p, reach);
  });
}

Turntable turntable(std::span<const Vec3f> points, float aspect, float margin, float reach,
                    Viewpoint viewpoint) {
  Box box;
  for (const Vec3f p : points) box.include(Vec3d(p));
  const Vec3f axis((box.low + box.high) / 2);
  const Camera camera = framing(aspect, margin, viewpoint, [&](Plane& plane) {
    for (const Vec3f p : points) {
      plane.include_turning({axis.x, p.y, axis.z}, std::hypot(p.x - axis.x, p.z - axis.z), reach);
    }
  });
  return {camera, axis};
}

Camera Turntable::at(double degrees) const {
  const double angle = std::fmod(degrees, 360) * kRadian;
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const auto turned = [&](Vec3f v) {
    return Vec3f(Vec3d{cosine * v.x + sine * v.z, v.y, cosine * v.z - sine * v.x});
  };
  Camera result = camera;
  result.eye = axis + turned(camera.eye - axis);
  result.right = turned(camera.right);
  result.up = turned(camera.up);
  result.forward = turned(camera.forward);
  return result;
}

Camera look_at(Vec3d eye, Vec3d target, Vec3d up, double angle_of_view, float aspect,
               const Placement& placement) {
  const Vec3d forward = normalized(target - eye);
  const Vec3d right = cross(forward, normalized(up));
  if (!(length(forward) > 0)) {
    throw Error(ErrorCode::usage, "the camera's eye and target are one point", "Move one of them.");
  }
  constexpr double kParallel = 1e-6;
  if (!(length(right) > kParallel)) {
    throw Error(ErrorCode::usage, "the camera's up has no direction in the picture",
                "Give one that is not along the view, such as 0 1 0.");
  }
  const bool is_open = angle_of_view > 0 && angle_of_view < 180;
  if (!is_open) {
    throw Error(ErrorCode::usage, "the camera's angle of view is not between 0 and 180 degrees",
                "Give one such as 30.");
  }
  const double longer = std::max(aspect, 1.0f), tangent = std::tan(angle_of_view / 2 * kRadian);
  Camera camera;
  camera.eye = placement(eye);
  camera.forward = Vec3f(forward);
  camera.right = Vec3f(normalized(right));
  camera.up = Vec3f(normalized(cross(right, forward)));
  camera.tan_x = static_cast<float>(tangent * aspect / longer);
  camera.tan_y = static_cast<float>(tangent / longer);
  return camera;
}

}  // namespace leafhull::render
