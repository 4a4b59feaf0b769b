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

/// The cells of the spatial hash: as large as R_max, or as a small part of the crown where R_max is
/// less. They do not depend on the resolution, so neither does the order of a sum.
Lattice hash_cells(const LeafSet& leaves, double radius_max);

/// The lattice for sums at leaf vertices; its bricks are the cells of the hash.
Lattice leaf_lattice(const LeafSet& leaves, double radius_max);

}  // namespace leafhull
