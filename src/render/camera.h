// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "leafhull/vec.h"
#include "render/placement.h"

namespace leafhull::render {

/// A pinhole camera.
struct Camera {
  Vec3f eye, right, up, forward;
  float tan_x, tan_y;  ///< of half the angle of view

  /// The direction through (x, y), both 0..1 over the picture, from its top left; not normalised.
  Vec3f direction(float x, float y) const {
    return forward + right * ((2 * x - 1) * tan_x) + up * ((1 - 2 * y) * tan_y);
  }
};

/// The direction in which a camera stands from its subject, degrees.
struct Viewpoint {
  float azimuth;    ///< about the vertical from +z towards +x
  float elevation;  ///< above the horizon
};
inline constexpr Viewpoint kFront{0, 0}, kThreeQuarter{32, 9}, kTop{0, 90};

/// A camera with a long lens whose picture of `aspect` (width / height) holds balls of radius
/// `reach` around `points`, leaving `margin`, a share of width and height, on each side.
Camera frame(std::span<const Vec3f> points, float aspect, float margin = 0.06f, float reach = 0,
             Viewpoint viewpoint = kThreeQuarter);

/// A camera that stands still before a subject on a turning table.
struct Turntable {
  Camera camera;
  Vec3f axis;  ///< a point of the vertical axis

  /// The camera after moving `degrees` about the axis, from +z towards +x.
  Camera at(double degrees) const;
};

/// Turns about the middle of the points' box; the picture holds them at every angle, as `frame`
/// does.
Turntable turntable(std::span<const Vec3f> points, float aspect, float margin = 0.06f,
                    float reach = 0, Viewpoint viewpoint = kThreeQuarter);

/// The camera at `eye` that looks at `target`, both in model space.
/// @param up the direction that is up in the picture; need not be orthogonal to the view
/// @param angle_of_view along the picture's longer side, degrees, between 0 and 180
/// @throws Error usage: eye and target are one point, up lies along the view, or the angle is out
/// of range
Camera look_at(Vec3d eye, Vec3d target, Vec3d up, double angle_of_view, float aspect,
               const Placement& placement = {});

}  // namespace leafhull::render
