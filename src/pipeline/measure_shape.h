// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "density/field.h"
#include "pipeline/prepared.h"
#include "pipeline/run.h"

namespace leafhull {

class Stages;

/// The share of the leaves that a surface leaves outside, pieces having been dropped in the cells
/// `dropped`.
double erosion_of(const Prepared& prepared, const Field& field, std::span<const Coord> dropped);

/// What Metrics says of the shape at the prepared T. Samples it, 64 voxels along.
double dilation_of(const Run& run, const Prepared& prepared);

/// The paper's metrics of a field, hollows filled, pieces having been dropped as above. `stages`
/// keep the dilation.
Metrics measure(const Run& run, Stages& stages, const Prepared& prepared, const Field& field,
                std::span<const Coord> dropped);

}  // namespace leafhull
