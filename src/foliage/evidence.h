// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "foliage/appearance.h"
#include "leafhull/leaves.h"

namespace leafhull {

// How much each thing speaks for leaves (above 0) or against them, in about the logarithm of the
// odds: what is said here is added up.

/// Green, autumn and blossom against brown and grey.
double colour_evidence(Vec3f linear);

/// Holes in the texture, where the triangles use it.
double alpha_evidence(const Appearance& look, AlphaMode mode, bool image_unread);

/// Many small flat pieces, or lobes, against tubes and what lies level at the foot.
double shape_evidence(const Appearance& look, std::size_t instances);

/// Above, where crowns are, against below. @param height of its middle, 0 at the foot of
/// everything in the file and 1 at the top.
double place_evidence(double height);

}  // namespace leafhull
