// SPDX-License-Identifier: Apache-2.0
#include "input/polygon.h"

#include <utility>

namespace leafhull {
namespace {

// Twice the signed area of a triangle seen from the tip of `normal`.
double area(Vec3d a, Vec3d b, Vec3d c, Vec3d normal) { return dot(cross(b - a, c - a), normal); }

Vec3d newell_normal(std::span<const Vec3d> polygon) {
  Vec3d normal;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    normal =
        normal + cross(polygon[i] - polygon[0], polygon[(i + 1) % polygon.size()] - polygon[0]);
  }
  return normal;
}

/// Cuts the first ear of the remaining polygon until none is left, in time quadratic in the
/// corners: a corner outside the triangle of a tip stays outside until a neighbour of the tip is
/// cut.
class EarCutter {
 public:
  explicit EarCutter(std::span<const Vec3d> polygon)
      : polygon_(polygon),
        normal_(newell_normal(polygon)),
        count_(static_cast<std::uint32_t>(polygon.size())),
        left_(count_),
        previous_(count_),
        next_(count_),
        blocker_(count_),
        is_cut_(count_) {
    for (std::uint32_t i = 0; i < count_; ++i) {
      previous_[i] = (i + count_ - 1) % count_;
      next_[i] = (i + 1) % count_;
    }
    for (std::uint32_t i = 0; i < count_; ++i) examine(i);
  }

  std::vector<std::array<std::uint32_t, 3>> run() {
    while (left_ > 3) cut(find_ear());
    triangles_.push_back({first_, next_[first_], previous_[first_]});
    return std::move(triangles_);
  }

 private:
  static constexpr std::uint32_t kNotConvex = ~0u;

  /// The first ear. If there is none, as the polygon crosses itself or has no area, the second
  /// corner.
  std::uint32_t find_ear() {
    std::uint32_t tip = first_;
    do {
      if (blocker_[tip] < count_ && is_cut_[blocker_[tip]]) find_blocker(tip);
      if (blocker_[tip] == count_) return tip;
      tip = next_[tip];
    } while (tip != first_);
    return next_[first_];
  }

  void cut(std::uint32_t tip) {
    const std::uint32_t before = previous_[tip], after = next_[tip];
    triangles_.push_back({before, tip, after});
    is_cut_[tip] = true;
    next_[before] = after;
    previous_[after] = before;
    if (tip == first_) first_ = after;
    --left_;
    examine(before);
    examine(after);
  }

  void examine(std::uint32_t tip) {
    blocker_[tip] = 0;
    if (area(polygon_[previous_[tip]], polygon_[tip], polygon_[next_[tip]], normal_) > 0) {
      find_blocker(tip);
    } else {
      blocker_[tip] = kNotConvex;
    }
  }

  /// Finds the next corner inside the triangle of `tip`, or goes past the last.
  void find_blocker(std::uint32_t tip) {
    const Vec3d a = polygon_[previous_[tip]], b = polygon_[tip], c = polygon_[next_[tip]];
    const auto is_inside = [&](Vec3d p) {
      return p != a && p != b && p != c && area(a, b, p, normal_) >= 0 &&
             area(b, c, p, normal_) >= 0 && area(c, a, p, normal_) >= 0;
    };
    std::uint32_t& i = blocker_[tip];
    while (i < count_ && (is_cut_[i] || !is_inside(polygon_[i]))) ++i;
  }

  std::span<const Vec3d> polygon_;
  Vec3d normal_;
  std::uint32_t count_, left_, first_ = 0;
  std::vector<std::uint32_t> previous_, next_;
  std::vector<std::uint32_t> blocker_;  ///< `count_` where the corner is an ear
  std::vector<bool> is_cut_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3d> polygon) {
  // Finding ears takes time quadratic in the number of corners.
  constexpr std::size_t kMostCorners = 50'000;
  if (polygon.size() > kMostCorners) {
    std::vector<std::array<std::uint32_t, 3>> fan;
    for (std::uint32_t i = 2; i < polygon.size(); ++i) fan.push_back({0, i - 1, i});
    return fan;
  }
  return EarCutter(polygon).run();
}

}  // namespace leafhull
