// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "density/field.h"
#include "pipeline/prepared.h"
#include "pipeline/run.h"

namespace leafhull {

class Stages;

/// The share of the leaves that a surface leaves outside, after pieces in the cells `dropped` were
/// dropped.
double erosion_of(const Prepared& prepared, const Field& field, std::span<const Coord> dropped);

/// Metrics::dilation of the shape at the prepared T. Samples the shape at 64 voxels along it.
double dilation_of(const Run& run, const Prepared& prepared);

/// The paper's metrics of a field whose hollows are filled and whose pieces are dropped as above.
/// `stages` keeps the dilation.
Metrics measure(const Run& run, Stages& stages, const Prepared& prepared, const Field& field,
                std::span<const Coord> dropped);

}  // namespace leafhull
