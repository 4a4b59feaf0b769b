// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "density/field.h"
#include "leafhull/shape.h"
#include "pipeline/pieces.h"
#include "pipeline/prepared.h"
#include "pipeline/run.h"
#include "pipeline/sample.h"

namespace leafhull {

/// What is known of an extraction before any work is done.
Report describe(const Options& resolved, const Grid& grid);

/// What is known once T is: the leaves, the device, the density.
Report describe(const Run& run, const Prepared& prepared);

/// Adds what is known of a surface.
void describe_pieces(const Pieces& pieces, Report& report);

/// Adds what is known of a mesh and of the field that it is of.
void describe_mesh(const Mesh& mesh, const Sampled& sampled, Report& report);

/// The places on the leaves with N below T, summed there.
std::uint64_t off_site(const Prepared& prepared);

/// Says why a surface is empty.
[[noreturn]] void refuse_empty(const Prepared& prepared, const Field& field);

}  // namespace leafhull
