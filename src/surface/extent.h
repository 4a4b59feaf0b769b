// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "density/field.h"

namespace leafhull {

/// Of each brick the corners of the box of its samples inside, model units: they hold the surface
/// to a voxel.
std::vector<Vec3d> extent_of(const Field& field);

}  // namespace leafhull
