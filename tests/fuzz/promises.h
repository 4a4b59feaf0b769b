// SPDX-License-Identifier: Apache-2.0
// Checks for the fuzzers: what readers promise for any bytes.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "leafhull/error.h"
#include "leafhull/tree.h"

namespace leafhull::fuzz {

inline void require(bool promise) {
  if (!promise) std::abort();
}

inline void require_one_line(const std::string& text) {
  require(text.find('\n') == std::string::npos);
}

inline void check(const Image& image) {
  if (image.empty()) return;
  require(image.width > 0 && image.height > 0);
  require(image.rgba.size() == std::size_t(image.width) * std::size_t(image.height) * 4);
}

inline void check(const Primitive& primitive) {
  const std::size_t count = primitive.positions.size();
  require(primitive.normals.empty() || primitive.normals.size() == count);
  require(primitive.uvs.empty() || primitive.uvs.size() == count);
  require(primitive.colors.empty() || primitive.colors.size() == count);
  for (const Vec3f p : primitive.positions) {
    require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  }
  for (const auto& triangle : primitive.triangles) {
    for (const std::uint32_t vertex : triangle) require(vertex < count);
  }
}

/// Checks what tree.h promises.
inline void check(const TreeModel& tree) {
  const auto is_index = [](int index, std::size_t count) {
    return index >= -1 && index < static_cast<std::int64_t>(count);
  };
  for (const Instance& instance : tree.instances) {
    require(instance.primitive < tree.primitives.size());
    require(is_index(instance.node, tree.nodes.size()));
    for (const auto& row : instance.to_world) {
      for (const double entry : row) require(std::isfinite(entry));
    }
  }
  for (const TreeNode& node : tree.nodes) require(is_index(node.parent, tree.nodes.size()));
  for (const Primitive& primitive : tree.primitives) {
    require(is_index(primitive.material, tree.materials.size()));
    check(primitive);
  }
  for (const Material& material : tree.materials) {
    require(is_index(material.base_color_image, tree.images.size()));
  }
  for (const Image& image : tree.images) check(image);
  for (const std::string& warning : tree.warnings) require_one_line(warning);
}

/// Runs `read`, which may refuse its input.
template <class Read>
int read_or_refuse(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    require(error.code() == ErrorCode::input);
    require_one_line(error.what());
  }
  return 0;
}

}  // namespace leafhull::fuzz
