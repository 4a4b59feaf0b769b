// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "density/field.h"
#include "leafhull/shape.h"
#include "pipeline/pieces.h"
#include "pipeline/prepared.h"
#include "pipeline/run.h"
#include "pipeline/sample.h"

namespace leafhull {

/// A report of what is known about an extraction before any work is done.
Report describe(const Options& resolved, const Grid& grid);

/// A report of what is known once T is known: the leaves, the device, the density.
Report describe(const Run& run, const Prepared& prepared);

/// Adds the counts of a surface's pieces to a report.
void describe_pieces(const Pieces& pieces, Report& report);

/// Adds the counts of a mesh and of the field that it comes from.
void describe_mesh(const Mesh& mesh, const Sampled& sampled, Report& report);

/// `there` is N at the places on the leaves.
/// @throws Error empty, always: it says why the surface is empty.
[[noreturn]] void refuse_empty(const Prepared& prepared, std::span<const float> there,
                               const Field& field);

}  // namespace leafhull
