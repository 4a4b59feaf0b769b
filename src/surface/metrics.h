// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "density/field.h"
#include "leafhull/shape.h"

namespace leafhull {

/// Counts inside, on and dilated voxels, and the `places` on the leaves that lie outside the
/// sampled field (`off_site_sampled`). A voxel that holds one of `places` or `others` is not
/// dilated. Both are in voxels from the field's anchor. SPEC: 6; Source: section 4, Figure 9.
Metrics measure(const Field& field, std::span<const Vec3d> places,
                std::span<const Vec3d> others = {});

/// The share of `places` (voxels from the field's anchor) that the shape leaves outside: below T
/// between the samples, unless in a hollow that was filled; or in a piece that was dropped, whose
/// surface passes through the cells `dropped`, ascending.
double share_outside(const Field& field, std::span<const Vec3d> places,
                     std::span<const Coord> dropped);

/// For each brick, the corners of the box around its samples inside, model units. Together they
/// bound the surface to within a voxel.
std::vector<Vec3d> extent_of(const Field& field);

}  // namespace leafhull
