// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "density/field.h"
#include "surface/polygonise.h"

namespace leafhull {

/// The surface N = T by dual marching cubes over the field's bricks: a vertex per patch of surface
/// in a cell, the mean of the patch's crossings with the lattice and within the cell; a quad per
/// lattice edge that the surface crosses. Closed and 2-manifold, in an order that depends on the
/// field alone. Every cell that the surface crosses has its lowest corner in an evaluated brick.
/// Source: Nielson, "Dual Marching Cubes", 2004; Wenger, "Isosurfaces", 2013, section 3.3.
Polygons mesh_bricks(const Field& field);

}  // namespace leafhull
