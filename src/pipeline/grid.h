// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "density/lattice.h"
#include "leafhull/leaves.h"
#include "leafhull/shape.h"

namespace leafhull {

/// Step 1 of the paper's Figure 8: sets the report's `radius_max_model`, `voxel_size` and
/// `resolution` from its options (resolved) and returns the lattice. SPEC: 4, 5.
/// @throws Error usage: R_max, a leaf's radii or the voxel size out of all proportion to the crown;
///         input: a crown without extent, or too far from the origin for doubles to hold its shape.
Lattice set_grid(const LeafSet& leaves, Report& report);

/// The lattice for sums at leaf vertices. Its bricks are as large as R_max, or as a small part of
/// the crown where R_max is less: what is computed there does not depend on the resolution.
Lattice leaf_lattice(const LeafSet& leaves, double radius_max);

}  // namespace leafhull
