// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "density/lattice.h"
#include "leafhull/leaves.h"
#include "leafhull/options.h"

namespace leafhull {

/// Step 1 of the paper's Figure 8.
struct Grid {
  double radius_max = 0;  ///< R_max, model units
  double voxel_size = 0;  ///< h, model units
  int resolution = 0;     ///< voxels along the crown grown by R_max on both sides
  Lattice lattice;        ///< anchored near the crown
};

/// The grid for options as resolve() returns them. SPEC: 4, 5.
/// @throws Error usage: R_max, a leaf's radii or the voxel size out of all proportion to the crown;
///         input: a crown without extent, or too far from the origin for doubles to hold its shape.
Grid grid_of(const LeafSet& leaves, const Options& resolved);

/// The cells of the spatial hash: as large as R_max, or as a small part of the crown where R_max is
/// less. They do not depend on the resolution, so neither does the order of a sum.
Lattice hash_cells(const LeafSet& leaves, double radius_max);

/// The lattice for sums at leaf vertices; its bricks are the cells of the hash.
Lattice leaf_lattice(const LeafSet& leaves, double radius_max);

}  // namespace leafhull
