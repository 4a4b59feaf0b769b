// SPDX-License-Identifier: Apache-2.0
#include "input/polygon.h"

#include <algorithm>
#include <numeric>

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

bool is_ear(std::span<const Vec3d> polygon, const std::vector<std::uint32_t>& rest, std::size_t tip,
            Vec3d normal) {
  const std::size_t count = rest.size();
  const Vec3d a = polygon[rest[(tip + count - 1) % count]];
  const Vec3d b = polygon[rest[tip]];
  const Vec3d c = polygon[rest[(tip + 1) % count]];
  if (area(a, b, c, normal) <= 0) return false;
  return std::ranges::none_of(rest, [&](std::uint32_t corner) {
    const Vec3d p = polygon[corner];
    return p != a && p != b && p != c && area(a, b, p, normal) >= 0 && area(b, c, p, normal) >= 0 &&
           area(c, a, p, normal) >= 0;
  });
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3d> polygon) {
  std::vector<std::uint32_t> rest(polygon.size());
  std::iota(rest.begin(), rest.end(), 0u);
  const Vec3d normal = newell_normal(polygon);

  std::vector<std::array<std::uint32_t, 3>> triangles;
  while (rest.size() > 3) {
    std::size_t tip = 0;
    while (tip < rest.size() && !is_ear(polygon, rest, tip, normal)) ++tip;
    if (tip == rest.size()) tip = 1;
    const std::size_t count = rest.size();
    triangles.push_back({rest[(tip + count - 1) % count], rest[tip], rest[(tip + 1) % count]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(tip));
  }
  triangles.push_back({rest[0], rest[1], rest[2]});
  return triangles;
}

}  // namespace leafhull
