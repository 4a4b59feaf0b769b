// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace leafhull {

// The single-sided material of shapes in glTF.
inline constexpr std::string_view kLeafMaterial = "leaves";
inline constexpr std::array<double, 4> kLeafColour{0.13, 0.3, 0.07, 1};
/// What meshes are called, by which is_shape() knows them.
inline constexpr std::string_view kShapeName = "abstract shape";

}  // namespace leafhull
