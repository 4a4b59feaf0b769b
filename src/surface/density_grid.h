// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openvdb/openvdb.h>

#include "density/field.h"

namespace leafhull {

/// N as a sparse grid named `density` on the global lattice, with metadata `threshold`: evaluated
/// samples active; what is proven inside, inactive tiles of a value above T; the background 0.
/// SPEC: 7.
openvdb::FloatGrid::Ptr density_grid(const Field& field);

}  // namespace leafhull
