// SPDX-License-Identifier: Apache-2.0
// Measures of leaf points for tests.
#pragma once

#include <numbers>
#include <vector>

#include "points/leaf_points.h"

namespace leafhull::test {

inline double area_of(const std::vector<LeafPoint>& points) {
  double sum = 0;
  for (const LeafPoint& point : points) sum += point.area;
  return sum;
}

/// N from isotropic kernels of radius R, in doubles.
inline double layers_at(const std::vector<LeafPoint>& points, Vec3d p, double radius) {
  double n = 0;
  for (const LeafPoint& point : points) {
    const Vec3d d = p - point.position;
    const double w = 1 - dot(d, d) / (radius * radius);
    if (w > 0) n += 3 * point.area / (std::numbers::pi * radius * radius) * w * w;
  }
  return n;
}

}  // namespace leafhull::test
