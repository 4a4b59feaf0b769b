// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pipeline/evaluate.h"
#include "surface/components.h"
#include "surface/polygonise.h"

namespace leafhull {

struct FinishedMesh {
  Mesh mesh;
  ComponentCount components;
};

/// Polygons in voxels of the lattice, with a report's options and threshold, as the mesh to hand
/// out: vertices moved onto N = T unless told not to, normals, triangles, small components dropped,
/// model units. SPEC: 5.
FinishedMesh finish_mesh(Polygons polygons, DensityFunction& density, const Lattice& lattice,
                         const Report& report);

}  // namespace leafhull
