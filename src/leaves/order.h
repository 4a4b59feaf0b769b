// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {

/// The order of positions along a Morton curve through the box `bounds`; what lies beyond it counts
/// as on its side. `precedes` tells which of two comes first that have one place on the curve.
std::vector<std::uint32_t> morton_order(
    std::span<const Vec3d> positions, const Box& bounds,
    const std::function<bool(std::uint32_t, std::uint32_t)>& precedes);

/// Sorts the vertices along a Morton curve through their bounds and numbers the leaves as they
/// appear there: an order that depends on the geometry alone.
/// `leaves`: bounds set; the vertices of a leaf side by side, leaves numbered in that order.
void sort_vertices(LeafSet& leaves);

}  // namespace leafhull
