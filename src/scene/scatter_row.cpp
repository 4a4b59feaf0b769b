// SPDX-License-Identifier: Apache-2.0
#include "scene/scatter_row.h"

#include <cmath>
#include <numbers>

namespace leafhull {
namespace {

constexpr double kHalfDegree = std::numbers::pi / 360;

/// Rotates by `b` first, then by `a`.
Rotation operator*(const Rotation& a, const Rotation& b) {
  return {
      a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
      a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

}  // namespace

Rotation rotation_of_yaw(double degrees) {
  return {0, std::sin(degrees * kHalfDegree), 0, std::cos(degrees * kHalfDegree)};
}

Rotation rotation_of_angles(Vec3d degrees) {
  const Vec3d half = degrees * kHalfDegree;
  const Rotation about_x{std::sin(half.x), 0, 0, std::cos(half.x)};
  const Rotation about_y{0, std::sin(half.y), 0, std::cos(half.y)};
  const Rotation about_z{0, 0, std::sin(half.z), std::cos(half.z)};
  return about_z * (about_y * about_x);
}

PlacedTree placed(const ScatterRow& row) {
  auto [x, y, z, w] = row.rotation;
  const double norm = std::hypot(std::hypot(x, y), std::hypot(z, w));
  x /= norm, y /= norm, z /= norm, w /= norm;
  const Vec3d& s = row.scale;
  const auto entry = [](double value) { return static_cast<float>(value); };
  PlacedTree tree;
  tree.position = row.position;
  tree.linear = {entry(s.x * (1 - 2 * (y * y + z * z))), entry(s.y * 2 * (x * y - z * w)),
                 entry(s.z * 2 * (x * z + y * w)),       entry(s.x * 2 * (x * y + z * w)),
                 entry(s.y * (1 - 2 * (x * x + z * z))), entry(s.z * 2 * (y * z - x * w)),
                 entry(s.x * 2 * (x * z - y * w)),       entry(s.y * 2 * (y * z + x * w)),
                 entry(s.z * (1 - 2 * (x * x + y * y)))};
  return tree;
}

}  // namespace leafhull
