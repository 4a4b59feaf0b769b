// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "density/field.h"

namespace leafhull {

/// For each brick, the corners of the box around its samples inside, model units. Together they
/// bound the surface to within a voxel.
std::vector<Vec3d> extent_of(const Field& field);

}  // namespace leafhull
