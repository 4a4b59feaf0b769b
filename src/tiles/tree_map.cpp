// SPDX-License-Identifier: Apache-2.0
#include "tiles/tree_map.h"

#include <cmath>

namespace leafhull {
namespace {

/// How far float rounding may move a map from a rotation and a scale.
constexpr double kSimilar = 1e-5;

}  // namespace

TreeMap::TreeMap(const PlacedTree& tree) : position_(tree.position) {
  const auto& m = tree.linear;
  const auto row = [&](int r) { return Vec3d(Vec3f(m[3 * r], m[3 * r + 1], m[3 * r + 2])); };
  x_ = row(0), y_ = row(1), z_ = row(2);
  const Vec3d yz = cross(y_, z_), zx = cross(z_, x_), xy = cross(x_, y_);
  const double determinant = dot(x_, yz);
  over_x_ = yz / determinant, over_y_ = zx / determinant, over_z_ = xy / determinant;
  volume_ = std::fabs(determinant);
  scale_ = std::cbrt(volume_);
  const double square = scale_ * scale_;
  const auto near = [&](double a, double b) { return std::fabs(a - b) <= kSimilar * square; };
  similar_ = near(dot(x_, x_), square) && near(dot(y_, y_), square) && near(dot(z_, z_), square) &&
             near(dot(x_, y_), 0) && near(dot(y_, z_), 0) && near(dot(z_, x_), 0);
  stretch_ = similar_ ? scale_ * (1 + kSimilar)
                      : std::sqrt(dot(x_, x_) + dot(y_, y_) + dot(z_, z_));  // Frobenius
}

Box TreeMap::operator()(const Box& box) const {
  const Vec3d centre = (*this)(0.5 * (box.low + box.high)), half = 0.5 * (box.high - box.low);
  const auto reach = [&](Vec3d row) {
    return std::fabs(row.x) * half.x + std::fabs(row.y) * half.y + std::fabs(row.z) * half.z;
  };
  const Vec3d r(reach(x_), reach(y_), reach(z_));
  return {centre - r, centre + r};
}

LatticeKernel TreeMap::operator()(const Kernel& kernel, const Lattice& lattice, int falloff) const {
  const Vec3d centre = (*this)(kernel.centre);
  const float top = falloff_root(kernel.weight, falloff);
  if (similar_ && is_isotropic(kernel)) {
    return to_lattice(centre, static_cast<double>(kernel.radius_major) * scale_, top, lattice);
  }
  const KernelForm form = form_of(kernel);
  const auto carried = [&](Vec3d axis) {
    return Vec3d(dot(axis, over_x_), dot(axis, over_y_), dot(axis, over_z_));
  };
  return to_lattice(centre, {carried(form.u), carried(form.v), carried(form.n)}, top, lattice);
}

}  // namespace leafhull
