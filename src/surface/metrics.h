// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "density/field.h"
#include "leafhull/shape.h"

namespace leafhull {

/// Inside, on and dilated voxels, and the leaf vertices that the sampled field leaves out
/// (`off_site_sampled`). `leaf_vertices` are in voxels from the field's anchor. SPEC: 6;
/// Source: section 4, Figure 9.
Metrics measure(const Field& field, std::span<const Vec3d> leaf_vertices);

}  // namespace leafhull
