// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "leafhull/scene.h"

namespace leafhull {

/// A quaternion of any length.
struct Rotation {
  double x = 0, y = 0, z = 0, w = 1;
};

/// A rotation about +y, right-handed.
Rotation rotation_of_yaw(double degrees);

/// A rotation about x, then y, then z, in degrees: the Euler angles XYZ of Blender.
Rotation rotation_of_angles(Vec3d degrees);

/// A line of a scatter file.
struct ScatterRow {
  std::string model;  ///< a tree file, as written
  Vec3d position;
  Rotation rotation;
  Vec3d scale{1, 1, 1};
};

/// What is wrong with a line; the line's reader knows where it is.
struct BadRow {
  std::string what, remedy;
};

/// The tree of a row, scaled, rotated and moved; its model is set later.
PlacedTree placed(const ScatterRow& row);

}  // namespace leafhull
