// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>

#include "leafhull/tree.h"

namespace leafhull {

inline Eigen::Vector3d to_eigen(const Vec3f& v) { return {v.x, v.y, v.z}; }
inline Vec3d to_vec3d(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
inline Vec3f to_vec3f(const Eigen::Vector3d& v) { return Vec3f(to_vec3d(v)); }

/// An instance's transform, taken apart.
struct Placement {
  Eigen::Matrix3d linear;
  Eigen::Matrix3d normals;  ///< transforms normals: the cofactors, det(linear) * inverse transpose
  Eigen::Vector3d translation;

  explicit Placement(const Transform& to_world) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) linear(row, column) = to_world[row][column];
      translation[row] = to_world[row][3];
    }
    for (int i = 0; i < 3; ++i) {
      normals.col(i) = linear.col((i + 1) % 3).cross(linear.col((i + 2) % 3));
    }
  }
};

}  // namespace leafhull
