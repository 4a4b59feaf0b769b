// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/evaluate.h"
#include "surface/polygonise.h"

namespace leafhull {

/// Polygons in voxels of the lattice as the mesh to hand out: vertices moved onto N = `threshold`
/// where `snap` says so, analytic normals, triangles, model units. SPEC: 5.
Mesh finish_mesh(Polygons polygons, DensityFunction& density, const Lattice& lattice,
                 double threshold, bool snap);

/// The same where the lattice puts the vertices, with normals of the faces around them.
Mesh lattice_mesh(Polygons polygons, const Lattice& lattice);

}  // namespace leafhull
