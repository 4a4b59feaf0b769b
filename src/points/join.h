// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {

/// Joins parts that share a cell of the world's lattice of edge `spacing`: those with an area much
/// smaller than spacing^2, or all of them if the cell holds more than a few layers of leaf in more
/// than four parts. A part that is joined to no other stays as it is.
std::vector<LeafPoint> join_in_cells(std::vector<LeafPoint> parts, double spacing);

}  // namespace leafhull
