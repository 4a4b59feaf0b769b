// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "leafhull/vec.h"

namespace leafhull {

/// A triangle, or what is left of one in a box.
class ConvexPolygon {
 public:
  void push_back(Vec2d corner) { corners_[size_++] = corner; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const Vec2d& operator[](std::size_t i) const { return corners_[i]; }

 private:
  std::array<Vec2d, 7> corners_;  // each side of a box adds one at most
  std::size_t size_ = 0;
};

/// Area and first moments; the order of the corners gives their sign.
struct PolygonMoments {
  double area = 0;
  Vec2d first;  ///< the integral of the position

  PolygonMoments& operator+=(const PolygonMoments& other) {
    area += other.area;
    first = {first.x + other.first.x, first.y + other.first.y};
    return *this;
  }
};

inline PolygonMoments moments_of(const ConvexPolygon& polygon) {
  PolygonMoments sum;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec2d a = polygon[0], b = polygon[i - 1], c = polygon[i];
    const double area = 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    sum += {area, {area * (a.x + b.x + c.x) / 3, area * (a.y + b.y + c.y) / 3}};
  }
  return sum;
}

/// The part of a polygon between two values of a coordinate.
inline ConvexPolygon clip(const ConvexPolygon& polygon, double Vec2d::*axis, double low,
                          double high) {
  const auto half = [axis](const ConvexPolygon& from, double bound, double sign) {
    ConvexPolygon part;
    for (std::size_t i = 0; i < from.size(); ++i) {
      const Vec2d a = from[i], b = from[(i + 1) % from.size()];
      const double da = sign * (a.*axis - bound), db = sign * (b.*axis - bound);
      if (da >= 0) part.push_back(a);
      if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
        const double t = da / (da - db);
        Vec2d cut{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
        cut.*axis = bound;
        part.push_back(cut);
      }
    }
    return part;
  };
  return half(half(polygon, low, 1), high, -1);
}

/// The lowest and the highest coordinates of a polygon that is not empty.
inline std::pair<Vec2d, Vec2d> extent(const ConvexPolygon& polygon) {
  Vec2d low = polygon[0], high = polygon[0];
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    low = {std::min(low.x, polygon[i].x), std::min(low.y, polygon[i].y)};
    high = {std::max(high.x, polygon[i].x), std::max(high.y, polygon[i].y)};
  }
  return {low, high};
}

}  // namespace leafhull
