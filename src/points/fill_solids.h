// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "leafhull/leaves.h"
#include "leaves/solids.h"

namespace leafhull {

/// Whether a closed surface is so thick that kernels on it would leave its middle empty, and is
/// therefore filled. `radius_max`: R_max, model units.
bool is_filled(const LeafSolid& solid, double radius_max);

/// Points in the cells of the world's lattice that a solid meets, as if its leaves were spread
/// evenly over its volume: each lies at the middle of the solid's part in the cell and has that
/// share of its leaf area. Their kernels are spheres of R_max under every method.
/// @throws Error usage: it would take more than ten million.
std::vector<LeafPoint> fill(const LeafSolid& solid, double radius_max);

}  // namespace leafhull
