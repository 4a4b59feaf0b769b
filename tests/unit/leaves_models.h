// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

#include "leafhull/leaves.h"

namespace leafhull::test {

/// Adds two triangles between four corners in a ring.
inline void add_quad(Primitive& primitive, const std::array<Vec3f, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(primitive.positions.size());
  primitive.positions.insert(primitive.positions.end(), corners.begin(), corners.end());
  primitive.triangles.push_back({first, first + 1, first + 2});
  primitive.triangles.push_back({first, first + 2, first + 3});
}

/// A card of width x height around the origin in the x, y plane, facing +z. Its texture coordinates
/// are the unit square with v down.
inline Primitive card(float width, float height) {
  Primitive primitive;
  const float x = width / 2;
  const float y = height / 2;
  add_quad(primitive, {Vec3f{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}});
  primitive.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  return primitive;
}

/// Adds the same triangles with reversed winding, over the same vertices.
inline void add_back_faces(Primitive& primitive) {
  const auto front = primitive.triangles;
  for (const auto& [a, b, c] : front) primitive.triangles.push_back({a, c, b});
}

/// A model with one material "leaf"; each primitive is placed once, untransformed.
inline TreeModel tree_of(std::vector<Primitive> primitives) {
  TreeModel tree;
  tree.materials.push_back({.name = "leaf"});
  for (Primitive& primitive : primitives) {
    primitive.material = 0;
    tree.instances.push_back({static_cast<std::uint32_t>(tree.primitives.size()), "node"});
    tree.primitives.push_back(std::move(primitive));
  }
  return tree;
}

/// A square image; `alpha` gives the alpha, 0 to 255, at a texel's centre (u, v).
inline Image alpha_image(int size, const std::function<int(double, double)>& alpha) {
  Image image{size, size, {}};
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const int a = alpha((x + 0.5) / size, (y + 0.5) / size);
      image.rgba.insert(image.rgba.end(), {255, 255, 255, static_cast<std::uint8_t>(a)});
    }
  }
  return image;
}

/// Opaque inside the ellipse with half axes `u_axis` and `v_axis`, fully cut away outside.
inline std::function<int(double, double)> opaque_inside(double centre_u, double centre_v,
                                                        double u_axis, double v_axis) {
  return [=](double u, double v) {
    return std::hypot((u - centre_u) / u_axis, (v - centre_v) / v_axis) <= 1 ? 255 : 0;
  };
}

inline LeafOptions with_globs(std::vector<std::string> globs) {
  LeafOptions options;
  options.globs = std::move(globs);
  return options;
}

inline LeafOptions with_ellipse(const TextureEllipse& ellipse) {
  LeafOptions options;
  options.ellipse = ellipse;
  return options;
}

inline LeafOptions with_scale(double scale) {
  LeafOptions options;
  options.scale = scale;
  return options;
}

/// `tree` with its material cut out by an image.
inline TreeModel masked(TreeModel tree, Image image, AlphaMode mode = AlphaMode::mask) {
  tree.images.push_back(std::move(image));
  tree.materials[0].alpha_mode = mode;
  tree.materials[0].base_color_image = 0;
  return tree;
}

}  // namespace leafhull::test
