// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {

/// The place of a position on a Morton curve through the box `bounds`; positions outside are
/// clamped to its sides.
std::uint64_t morton_code(Vec3d position, const Box& bounds);

/// The order of things by their codes. `precedes` decides between two with the same code.
std::vector<std::uint32_t> order_by_code(
    std::size_t count, const std::function<std::uint64_t(std::uint32_t)>& code,
    const std::function<bool(std::uint32_t, std::uint32_t)>& precedes);

/// Moves `values[order[i]]` to place i without taking more memory. `order` holds each place once.
template <class Value>
void put_in_order(std::vector<Value>& values, std::vector<std::uint32_t> order) {
  for (std::uint32_t first = 0; first < order.size(); ++first) {
    if (order[first] == first) continue;
    Value held = std::move(values[first]);
    std::uint32_t at = first;
    for (std::uint32_t from = order[at]; from != first; from = order[at]) {
      values[at] = std::move(values[from]);
      order[at] = at;
      at = from;
    }
    values[at] = std::move(held);
    order[at] = at;
  }
}

/// Sorts the vertices along a Morton curve through their bounds and numbers the leaves as they
/// appear there: an order that depends on the geometry alone.
/// `leaves` must have its bounds set, the vertices of a leaf together and leaves in that order.
void sort_vertices(LeafSet& leaves);

}  // namespace leafhull
