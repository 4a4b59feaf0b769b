// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {

/// Joins parts that lie together, in the cells of the world's lattice of edge `spacing`: those much
/// smaller than spacing^2 in area, or all in a cell that holds more than a few layers of leaf in
/// more than four parts. A part that is joined to no other stays as it is.
std::vector<LeafPoint> join_in_cells(std::vector<LeafPoint> parts, double spacing);

}  // namespace leafhull
