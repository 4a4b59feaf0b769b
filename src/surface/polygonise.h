// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "density/field.h"
#include "leafhull/vec.h"

namespace leafhull {

/// A closed mesh of quads and triangles in voxels from the field's anchor, counter-clockwise seen
/// from outside. A triangle repeats its last index.
struct Polygons {
  std::vector<Vec3f> points;
  std::vector<std::array<std::uint32_t, 4>> faces;
};

/// The surface N = T, by OpenVDB's volume-to-mesh. `adaptivity` from 0 (regular) to 1 merges cells
/// whose normals agree.
Polygons polygonise(const Field& field, double adaptivity);

/// Triangles of the faces, each quad cut along its shorter diagonal.
std::vector<std::array<std::uint32_t, 3>> triangulate(const Polygons& polygons);

}  // namespace leafhull
