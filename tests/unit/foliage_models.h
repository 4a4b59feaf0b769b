// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>
#include <utility>

#include "leaves_models.h"

namespace leafhull::test {

/// An open cylinder along y.
inline Primitive tube(float radius, float low, float high, int sides = 8) {
  Primitive primitive;
  for (int i = 0; i < sides; ++i) {
    const auto angle = 2 * M_PI * i / sides;
    const auto x = radius * static_cast<float>(std::cos(angle));
    const auto z = radius * static_cast<float>(std::sin(angle));
    primitive.positions.push_back({x, low, z});
    primitive.positions.push_back({x, high, z});
  }
  for (int i = 0; i < sides; ++i) {
    const auto a = static_cast<std::uint32_t>(2 * i);
    const auto b = static_cast<std::uint32_t>(2 * ((i + 1) % sides));
    primitive.triangles.push_back({a, a + 1, b});
    primitive.triangles.push_back({b, a + 1, b + 1});
  }
  return primitive;
}

/// A ball of 8 by 16 quads and triangles.
inline Primitive ball(Vec3f centre, float radius) {
  constexpr int kRows = 8, kColumns = 16;
  Primitive primitive;
  for (int row = 0; row <= kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const double down = M_PI * row / kRows, round = 2 * M_PI * column / kColumns;
      primitive.positions.push_back(centre +
                                    Vec3f(Vec3d(std::sin(down) * std::cos(round), std::cos(down),
                                                std::sin(down) * std::sin(round))) *
                                        radius);
    }
  }
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const std::uint32_t a = row * kColumns + column;
      const std::uint32_t b = row * kColumns + (column + 1) % kColumns;
      primitive.triangles.push_back({a, b, a + kColumns});
      primitive.triangles.push_back({b, b + kColumns, a + kColumns});
    }
  }
  return primitive;
}

/// Small cards all over a ball.
inline Primitive cards(Vec3f centre, float radius, int count = 200, float half = 0.05f) {
  Primitive primitive;
  for (int i = 0; i < count; ++i) {
    // Evenly over the ball's surface. Source: Vogel's spiral.
    const double y = 1 - 2 * (i + 0.5) / count, round = i * 2.39996323;
    const double around = std::sqrt(1 - y * y);
    const Vec3f at =
        centre + Vec3f(Vec3d(around * std::cos(round), y, around * std::sin(round))) * radius;
    add_quad(primitive, {at + Vec3f{-half, -half, 0}, at + Vec3f{half, -half, 0},
                         at + Vec3f{half, half, 0}, at + Vec3f{-half, half, 0}});
    for (const Vec2f uv : {Vec2f{0, 1}, Vec2f{1, 1}, Vec2f{1, 0}, Vec2f{0, 0}})
      primitive.uvs.push_back(uv);
  }
  return primitive;
}

/// A level square.
inline Primitive ground(float half, float height = 0) {
  Primitive primitive;
  add_quad(primitive, {Vec3f{-half, height, half},
                       {half, height, half},
                       {half, height, -half},
                       {-half, height, -half}});
  return primitive;
}

/// Both in one primitive, the second after the first.
inline Primitive joined(Primitive first, const Primitive& second) {
  const auto base = static_cast<std::uint32_t>(first.positions.size());
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(first.positions, second.positions);
  append(first.uvs, second.uvs);
  append(first.colors, second.colors);
  for (const auto& [a, b, c] : second.triangles) {
    first.triangles.push_back({base + a, base + b, base + c});
  }
  return first;
}

/// The primitive with the same colour at every vertex.
inline Primitive coloured(Primitive primitive, Vec3f linear) {
  primitive.colors.assign(primitive.positions.size(), linear);
  return primitive;
}

/// The primitive with all texture coordinates at one point, as on a palette.
inline Primitive swatch(Primitive primitive, Vec2f uv) {
  primitive.uvs.assign(primitive.positions.size(), uv);
  return primitive;
}

inline constexpr Vec3f kGreen{0.1f, 0.3f, 0.05f}, kBrown{0.12f, 0.06f, 0.03f};

inline Material painted(std::string name, Vec3f linear) {
  return {.name = std::move(name), .base_color = {linear.x, linear.y, linear.z, 1}};
}

/// A primitive with its own names and material.
struct Thing {
  Thing(Primitive shape, Material painted_so, std::string mesh_name = "",
        std::string node_name = "")
      : primitive(std::move(shape)),
        material(std::move(painted_so)),
        mesh(std::move(mesh_name)),
        node(std::move(node_name)) {}

  Primitive primitive;
  Material material;
  std::string mesh, node;
};

/// A model in which each thing is placed once, untransformed.
inline TreeModel model_of(std::vector<Thing> things) {
  TreeModel tree;
  tree.path = "oak.glb";
  for (Thing& thing : things) {
    const auto number = static_cast<int>(tree.primitives.size());
    thing.primitive.material = number;
    thing.primitive.mesh_name = thing.mesh;
    tree.materials.push_back(std::move(thing.material));
    tree.primitives.push_back(std::move(thing.primitive));
    tree.nodes.push_back({thing.node});
    tree.instances.push_back({static_cast<std::uint32_t>(number), thing.node, kIdentity, number});
  }
  return tree;
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// For each instance, whether it is taken as leaves.
inline std::vector<bool> taken(const TreeModel& tree, const LeafOptions& options = {}) {
  return choose_leaves(tree, options).instances;
}

inline Primitive trunk() { return tube(0.2f, 0, 3); }
inline Primitive crown() { return ball({0, 4, 0}, 1.5f); }

}  // namespace leafhull::test
