// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "colour/colour.h"

namespace leafhull {

/// The name of the single-sided material of shapes in glTF.
inline constexpr std::string_view kLeafMaterial = "leaves";

/// Its base colour for leaves of a linear colour.
inline std::array<double, 4> leaf_base_color(Vec3f colour) {
  const auto decimal = [](float x) { return std::round(1e4 * static_cast<double>(x)) / 1e4; };
  return {decimal(colour.x), decimal(colour.y), decimal(colour.z), 1};
}

/// The name of meshes, by which is_shape() recognises them.
inline constexpr std::string_view kShapeName = "abstract shape";

}  // namespace leafhull
