// SPDX-License-Identifier: Apache-2.0
// Small trees with a known visible leaf area, and the same trees with another tessellation.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "leafhull/tree.h"
#include "unit/leaves_models.h"

namespace leafhull::test {

/// Random numbers that are the same on every machine.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  /// A number in [0, 1).
  double operator()() { return static_cast<double>(engine_()) / 4294967296.0; }
  Vec3d in_ball(double radius) {
    for (;;) {
      const Vec3d p((*this)() * 2 - 1, (*this)() * 2 - 1, (*this)() * 2 - 1);
      if (length(p) <= 1) return p * radius;
    }
  }
  Vec3d direction() { return normalized(in_ball(1)); }
  std::mt19937& engine() { return engine_; }

 private:
  std::mt19937 engine_;
};

/// Adds four corners around a centre; the texture coordinates are the unit square.
inline void add_card(Primitive& primitive, Vec3d centre, Vec3d u, Vec3d v) {
  add_quad(primitive, {Vec3f(centre - u - v), Vec3f(centre + u - v), Vec3f(centre + u + v),
                       Vec3f(centre - u + v)});
  primitive.uvs.insert(primitive.uvs.end(), {Vec2f{0, 1}, {1, 1}, {1, 0}, {0, 0}});
}

/// Cards in random directions in a ball.
inline Primitive cards_in_ball(int count, double radius, double width, double height) {
  Random random(5);
  Primitive primitive;
  for (int i = 0; i < count; ++i) {
    const Vec3d centre = random.in_ball(radius), n = random.direction();
    const Vec3d u = normalized(cross(n, random.direction()));
    add_card(primitive, centre, u * (width / 2), cross(n, u) * (height / 2));
  }
  return primitive;
}

/// An off-centre ellipse with a hole, 32 texels wide.
inline Image leaf_mask() {
  return alpha_image(32, [](double u, double v) {
    return std::hypot((u - 0.45) / 0.35, (v - 0.55) / 0.4) <= 1 &&
                   std::hypot(u - 0.5, v - 0.4) > 0.1
               ? 255
               : 0;
  });
}

/// Large cards that are mostly transparent.
inline TreeModel card_tree(int count = 120) {
  return masked(tree_of({cards_in_ball(count, 2, 1.2, 0.9)}), leaf_mask());
}

/// Thin leaves that are much smaller than the spacing of points.
inline TreeModel needle_tree() { return tree_of({cards_in_ball(8000, 1.5, 0.3, 0.02)}); }

/// Two crossing cards, visible from -0.8 to 0.6 across and from -0.9 to 0.7 along their middle.
inline TreeModel crossed_billboard() {
  Primitive primitive;
  add_card(primitive, {}, {1, 0, 0}, {0, 1, 0});
  add_card(primitive, {}, {0, 0, 1}, {0, 1, 0});
  return masked(tree_of({primitive}), leaf_mask());
}

/// A closed crown of 80 faces with its corners at distance 2.
inline TreeModel closed_sphere() {
  Primitive p;
  const float g = std::numbers::phi_v<float>;
  for (const float a : {-1.0f, 1.0f}) {
    for (const float b : {-g, g}) {
      p.positions.push_back({0, a, b});
      p.positions.push_back({a, b, 0});
      p.positions.push_back({b, 0, a});
    }
  }
  // The faces are the triples of corners that are 2 apart, turned outward.
  const auto near = [&](std::uint32_t a, std::uint32_t b) {
    return length(p.positions[a] - p.positions[b]) < 2.1f;
  };
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
        const bool out = dot(p.positions[a], cross(p.positions[b], p.positions[c])) > 0;
        p.triangles.push_back(out ? std::array{a, b, c} : std::array{a, c, b});
      }
    }
  }
  Primitive fine;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  fine.positions = p.positions;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, added] = middles.try_emplace(std::minmax(a, b), fine.positions.size());
    if (added) fine.positions.push_back((p.positions[a] + p.positions[b]) * 0.5f);
    return at->second;
  };
  for (const auto& [a, b, c] : p.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& t : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
      fine.triangles.push_back(t);
    }
  }
  for (Vec3f& q : fine.positions) q = normalized(q) * 2.0f;
  return tree_of({fine});
}

/// Separate cards in place of the faces of closed_sphere(): a crown that encloses a hollow but is
/// not a solid.
inline TreeModel sphere_of_cards() {
  TreeModel tree = closed_sphere();
  const Primitive whole = tree.primitives[0];
  Primitive& p = tree.primitives[0];
  p.positions.clear(), p.triangles.clear();
  for (const auto& [a, b, c] : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(p.positions.size());
    const Vec3f middle =
        (whole.positions[a] + whole.positions[b] + whole.positions[c]) * (1 / 3.0f);
    for (const std::uint32_t v : {a, b, c}) {
      p.positions.push_back(middle + (whole.positions[v] - middle) * 0.999f);
    }
    p.triangles.push_back({first, first + 1, first + 2});
  }
  return tree;
}

/// A closed crown of six faces that measures 3 x 2 x 2.
inline TreeModel closed_box() {
  Primitive p;
  const Vec3d half[] = {{1.5, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d n = half[axis], u = half[(axis + 1) % 3], v = half[(axis + 2) % 3];
    add_card(p, n, u, v);
    add_card(p, -n, v, u);
  }
  p.uvs.clear();
  return tree_of({p});
}

/// Half a cylinder of radius 1.5, welded from flat quads along its axis and visible in discs.
inline TreeModel curved_sheet() {
  constexpr int kAround = 12, kAlong = 8;
  Primitive p;
  for (int i = 0; i <= kAround; ++i) {
    for (int j = 0; j <= kAlong; ++j) {
      const double turn = i * std::numbers::pi / kAround;
      p.positions.emplace_back(Vec3d(1.5 * std::cos(turn), 1.5 * std::sin(turn), 0.4 * j));
      p.uvs.push_back({static_cast<float>(i) / kAround, static_cast<float>(j) / kAlong});
    }
  }
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kAlong; ++j) {
      const auto a = static_cast<std::uint32_t>(i * (kAlong + 1) + j), b = a + kAlong + 1;
      p.triangles.push_back({a, b, b + 1});
      p.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return masked(tree_of({p}), alpha_image(96, [](double u, double v) {
                  return std::hypot(u * 6 - std::floor(u * 6) - 0.5,
                                    v * 5 - std::floor(v * 5) - 0.5) <= 0.45
                             ? 255
                             : 0;
                }));
}

/// Cuts every triangle into four at the midpoints of its sides.
inline Primitive in_quarters(const Primitive& whole) {
  Primitive fine = whole;
  fine.triangles.clear();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, added] = middles.try_emplace(std::minmax(a, b), fine.positions.size());
    if (added) {
      fine.positions.push_back((whole.positions[a] + whole.positions[b]) * 0.5f);
      if (!whole.uvs.empty()) {
        const Vec2f p = whole.uvs[a], q = whole.uvs[b];
        fine.uvs.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2});
      }
    }
    return at->second;
  };
  for (const auto& [a, b, c] : whole.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& t : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
      fine.triangles.push_back(t);
    }
  }
  return fine;
}

/// Gives every triangle its own vertices.
inline Primitive with_split_vertices(const Primitive& whole) {
  Primitive split;
  for (const auto& triangle : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(split.positions.size());
    for (const std::uint32_t v : triangle) {
      split.positions.push_back(whole.positions[v]);
      if (!whole.uvs.empty()) split.uvs.push_back(whole.uvs[v]);
    }
    split.triangles.push_back({first, first + 1, first + 2});
  }
  return split;
}

/// Turns pairs of triangles a b c, a c d into b c d, b d a, and reorders all of them.
inline Primitive along_the_other_diagonal(const Primitive& whole) {
  Primitive other = whole;
  for (std::size_t i = 0; i + 1 < other.triangles.size(); i += 2) {
    const auto [a, b, c] = whole.triangles[i];
    const auto [a2, c2, d] = whole.triangles[i + 1];
    if (a != a2 || c != c2) continue;
    other.triangles[i] = {b, c, d};
    other.triangles[i + 1] = {b, d, a};
  }
  std::shuffle(other.triangles.begin(), other.triangles.end(), Random(3).engine());
  return other;
}

template <class Change>
TreeModel with_primitives(TreeModel tree, Change&& change) {
  for (Primitive& primitive : tree.primitives) {
    const int material = primitive.material;
    primitive = change(primitive);
    primitive.material = material;
  }
  return tree;
}

}  // namespace leafhull::test
