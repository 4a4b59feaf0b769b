// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "leafhull/vec.h"

namespace leafhull {

/// Cuts a plane polygon of three corners or more, concave ones too, into triangles of its corners
/// with its orientation, by clipping ears. A twisted or degenerate polygon is cut as well as
/// possible, one of more than 50,000 corners as a fan.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec3d> polygon);

}  // namespace leafhull
