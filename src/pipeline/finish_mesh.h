// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/evaluate.h"
#include "surface/polygonise.h"

namespace leafhull {

/// Turns polygons in voxels of the lattice into the final mesh: vertices moved onto N = `threshold`
/// if `snap` says so, analytic normals, triangles, model units. SPEC: 5.
Mesh finish_mesh(Polygons polygons, DensityFunction& density, const Lattice& lattice,
                 double threshold, bool snap);

/// As above with vertices where the lattice puts them, and the normals of the faces around them.
Mesh lattice_mesh(Polygons polygons, const Lattice& lattice);

}  // namespace leafhull
