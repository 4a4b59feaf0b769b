// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "density/field.h"
#include "surface/polygonise.h"

namespace leafhull {

/// The surface N = T by dual marching cubes over the field's bricks: a vertex per patch of surface
/// in a cell, the mean of the patch's crossings with the lattice and within the cell; a quad per
/// lattice edge that the surface crosses. Closed and 2-manifold, in an order that depends on the
/// field alone. Every cell that the surface crosses has its lowest corner in an evaluated brick.
/// Source: Nielson, "Dual Marching Cubes", 2004; Wenger, "Isosurfaces", 2013, section 3.3.
Polygons mesh_bricks(const Field& field);

/// A part of a surface.
struct OwnedPolygons {
  Polygons polygons;
  std::uint32_t own = 0;              ///< points, which come first
  std::vector<std::uint8_t> patches;  ///< each point's number among those of its cell
};

/// The part of mesh_bricks(field) in the cells of `own`, which is made of whole bricks. It has the
/// points in these cells, then the points of upper neighbours that its faces use, ascending by
/// cell; and the faces whose lowest cell is in `own`. Points are multiples of 2^-14 voxels. The
/// field must be known one brick beyond `own`. Points and faces do not depend on part or anchor.
OwnedPolygons mesh_bricks(const Field& field, const SampleBox& own);

}  // namespace leafhull
