// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/leaves.h"

namespace leafhull {

/// Sorts the vertices along a Morton curve through their bounds and numbers the leaves as they
/// appear there: an order that depends on the geometry alone.
/// `leaves`: bounds set; the vertices of a leaf side by side, leaves numbered in that order.
void sort_vertices(LeafSet& leaves);

}  // namespace leafhull
