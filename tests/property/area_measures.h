// SPDX-License-Identifier: Apache-2.0
// Measures of kernels and meshes in doubles, computed without leafhull's code.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "leafhull/shape.h"
#include "leafhull/tree.h"
#include "property/area_trees.h"

namespace leafhull::test {

using Corners = std::array<Vec3d, 3>;

inline std::vector<Corners> corners_of(const Mesh& mesh) {
  const auto at = [&](std::uint32_t v) { return mesh.origin + Vec3d(mesh.positions[v]); };
  std::vector<Corners> corners;
  for (const auto& [a, b, c] : mesh.triangles) corners.push_back({at(a), at(b), at(c)});
  return corners;
}

inline double volume(std::span<const Corners> triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += dot(a, cross(b, c));
  return sum / 6;
}
inline double volume(const Mesh& mesh) { return volume(corners_of(mesh)); }

/// Finds things by the lattice cells that their boxes meet.
class Cells {
 public:
  explicit Cells(double edge) : edge_(edge) {}

  void add(const Box& box, std::uint32_t thing) {
    visit(box, [&](std::uint64_t key) { cells_[key].push_back(thing); });
  }
  /// Calls see(thing) for everything that may meet a box, for some things more than once.
  template <class See>
  void near(const Box& box, See&& see) const {
    visit(box, [&](std::uint64_t key) {
      const auto cell = cells_.find(key);
      if (cell == cells_.end()) return;
      for (const std::uint32_t thing : cell->second) see(thing);
    });
  }

 private:
  template <class Visit>
  void visit(const Box& box, Visit&& visit) const {
    const auto cell = [&](double v) { return std::llround(std::floor(v / edge_)); };
    for (auto x = cell(box.low.x); x <= cell(box.high.x); ++x) {
      for (auto y = cell(box.low.y); y <= cell(box.high.y); ++y) {
        for (auto z = cell(box.low.z); z <= cell(box.high.z); ++z) {
          const auto part = [](long long c) { return static_cast<std::uint64_t>(c) & 0x1fffff; };
          visit(part(x) << 42 | part(y) << 21 | part(z));
        }
      }
    }
  }

  double edge_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

inline Box around(Vec3d p, double reach) {
  const Vec3d r(reach, reach, reach);
  return {p - r, p + r};
}

/// Evaluates N from a shape's kernels. SPEC: 2.
class Layers {
 public:
  Layers(std::vector<Kernel> kernels, double radius_max, int falloff)
      : kernels_(std::move(kernels)), falloff_(falloff), cells_(radius_max) {
    for (std::uint32_t j = 0; j < kernels_.size(); ++j) {
      const Kernel& k = kernels_[j];
      const float reach = std::max({k.radius_major, k.radius_minor, k.radius_normal});
      cells_.add(around(k.centre, static_cast<double>(reach)), j);
    }
  }
  explicit Layers(const Shape& shape)
      : Layers(shape.kernels, shape.report.radius_max_model, shape.report.options.falloff) {}

  double operator()(Vec3d p) const {
    double sum = 0;
    cells_.near(around(p, 0), [&](std::uint32_t j) {
      const Kernel& k = kernels_[j];
      const Vec3d n(k.normal), u(k.major), d = p - k.centre;
      const auto share = [&](Vec3d axis, float radius) {
        return std::pow(dot(axis, d) / static_cast<double>(radius), 2);
      };
      const double xi =
          share(u, k.radius_major) + share(cross(n, u), k.radius_minor) + share(n, k.radius_normal);
      if (xi < 1) sum += static_cast<double>(k.weight) * std::pow(1 - xi, falloff_);
    });
    return sum;
  }

 private:
  std::vector<Kernel> kernels_;
  int falloff_;
  Cells cells_;
};

/// Tells whether a point lies within closed triangles, by how many a ray along x crosses.
class Solid {
 public:
  /// @param edge about the length of a triangle
  Solid(std::vector<Corners> triangles, double edge)
      : triangles_(std::move(triangles)), cells_(edge) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      Box box;
      for (const Vec3d& p : triangles_[t]) box.include({0, p.y, p.z});
      cells_.add(box, t);
    }
  }

  bool holds(Vec3d p) const {
    // Moves the ray off the planes of the lattice, where vertices may lie.
    p = p + Vec3d(0, 3.1e-7, 2.7e-7);
    bool inside = false;
    cells_.near(around({0, p.y, p.z}, 0), [&](std::uint32_t t) {
      const auto& [a, b, c] = triangles_[t];
      const auto turn = [&](Vec3d from, Vec3d to) {
        return (to.y - from.y) * (p.z - from.z) - (to.z - from.z) * (p.y - from.y);
      };
      const double wa = turn(b, c), wb = turn(c, a), wc = turn(a, b);
      if ((wa > 0) != (wb > 0) || (wb > 0) != (wc > 0)) return;
      inside ^= (wa * a.x + wb * b.x + wc * c.x) / (wa + wb + wc) > p.x;
    });
    return inside;
  }

 private:
  std::vector<Corners> triangles_;
  Cells cells_;
};

/// The distance from a point to a triangle.
inline double distance(Vec3d p, const Corners& t) {
  const Vec3d n = normalized(cross(t[1] - t[0], t[2] - t[0]));
  bool above = true;
  double nearest = HUGE_VAL;
  for (int i = 0; i < 3; ++i) {
    const Vec3d a = t[i], side = t[(i + 1) % 3] - a;
    above = above && dot(cross(side, p - a), n) >= 0;
    const double along = std::clamp(dot(p - a, side) / dot(side, side), 0.0, 1.0);
    nearest = std::min(nearest, length(p - a - side * along));
  }
  return above ? std::fabs(dot(p - t[0], n)) : nearest;
}

/// The 95th percentile of the distance from the vertices of one mesh to the other, at most `most`.
inline double distance_between(const Mesh& a, const Mesh& b, double most) {
  const std::vector<Corners> triangles = corners_of(b);
  Cells cells(most);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    Box box;
    for (const Vec3d& p : triangles[t]) box.include(p);
    cells.add(box, t);
  }
  std::vector<double> distances;
  for (std::size_t v = 0; v < a.positions.size(); v += 3) {
    const Vec3d p = a.origin + Vec3d(a.positions[v]);
    double nearest = most;
    cells.near(around(p, most),
               [&](std::uint32_t t) { nearest = std::min(nearest, distance(p, triangles[t])); });
    distances.push_back(nearest);
  }
  const auto at = distances.begin() + static_cast<std::ptrdiff_t>(0.95 * distances.size());
  std::ranges::nth_element(distances, at);
  return *at;
}

/// The share of a mask's texels that are visible.
inline double visible_share(const Image& mask) {
  std::size_t kept = 0;
  for (std::size_t i = 3; i < mask.rgba.size(); i += 4) kept += mask.rgba[i] >= 128;
  return static_cast<double>(kept) / (static_cast<double>(mask.rgba.size()) / 4);
}

/// The visible area of a tree, texel by texel or, without a mask, triangle by triangle. In masked
/// trees each quad must show the whole picture.
inline double visible_area(const TreeModel& tree) {
  double area = 0;
  for (const Primitive& p : tree.primitives) {
    for (const auto& [a, b, c] : p.triangles) {
      const Vec3d from(p.positions[a]);
      area += length(cross(Vec3d(p.positions[b]) - from, Vec3d(p.positions[c]) - from)) / 2;
    }
  }
  return tree.images.empty() ? area : area * visible_share(tree.images[0]);
}

/// Random points on the visible area, in proportion to each triangle's area.
inline std::vector<Vec3d> places_on(const TreeModel& tree, std::size_t count) {
  Random random(17);
  const Primitive& p = tree.primitives[0];
  std::vector<double> up_to;
  double area = 0;
  for (const auto& [a, b, c] : p.triangles) {
    const Vec3d from(p.positions[a]);
    area += length(cross(Vec3d(p.positions[b]) - from, Vec3d(p.positions[c]) - from));
    up_to.push_back(area);
  }
  std::vector<Vec3d> places;
  while (places.size() < count) {
    const auto t =
        static_cast<std::size_t>(std::ranges::upper_bound(up_to, random() * area) - up_to.begin());
    const auto [a, b, c] = p.triangles[std::min(t, up_to.size() - 1)];
    double s = random(), r = random();
    if (s + r > 1) s = 1 - s, r = 1 - r;
    if (!tree.images.empty()) {
      const auto mix = [&](float Vec2f::*axis) {
        return (1 - s - r) * static_cast<double>(p.uvs[a].*axis) +
               s * static_cast<double>(p.uvs[b].*axis) + r * static_cast<double>(p.uvs[c].*axis);
      };
      const Image& image = tree.images[0];
      const auto texel = [](double v, int size) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(v * size), 0, size - 1));
      };
      const std::size_t at =
          texel(mix(&Vec2f::y), image.height) * static_cast<std::size_t>(image.width) +
          texel(mix(&Vec2f::x), image.width);
      if (image.rgba[4 * at + 3] < 128) continue;
    }
    places.push_back(Vec3d(p.positions[a]) * (1 - s - r) + Vec3d(p.positions[b]) * s +
                     Vec3d(p.positions[c]) * r);
  }
  return places;
}

}  // namespace leafhull::test
