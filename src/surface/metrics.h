// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openvdb/openvdb.h>

#include <span>

#include "density/field.h"
#include "leafhull/shape.h"

namespace leafhull {

/// Inside, on and dilated voxels, and the leaf vertices that the sampled field leaves out
/// (`off_site_sampled`). `depth` is depth_grid(field); `leaf_vertices` are in voxels from the
/// field's anchor. SPEC: 6; Source: section 4, Figure 9.
Metrics measure(const Field& field, const openvdb::FloatGrid& depth,
                std::span<const Vec3d> leaf_vertices);

}  // namespace leafhull
