// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "leafhull/leaves.h"

namespace leafhull {

/// A leaf point with the ellipse of second moments: half axes of two standard deviations in the
/// plane across `normal`, none below `least_radius`. `moments` are central, over the area.
inline LeafPoint ellipse_of(Vec3d centre, double area, const Eigen::Vector3d& normal,
                            const Eigen::Matrix3d& moments, double least_radius) {
  const Eigen::Vector3d first = normal.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> plane;
  plane << first, normal.cross(first);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal(plane.transpose() * moments *
                                                                 plane);
  const auto radius = [&](int i) {
    const double deviation = std::sqrt(std::max(principal.eigenvalues()[i], 0.0));
    return static_cast<float>(std::max(2 * deviation, least_radius));
  };
  const Eigen::Vector3d major = (plane * principal.eigenvectors().col(1)).normalized();
  const auto vector = [](const Eigen::Vector3d& v) { return Vec3f(Vec3d(v.x(), v.y(), v.z())); };
  return {centre, vector(normal), vector(major), radius(1), radius(0), area};
}

}  // namespace leafhull
