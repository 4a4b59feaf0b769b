// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "foliage/appearance.h"
#include "leafhull/leaves.h"

namespace leafhull {

// How much each thing speaks for leaves (above 0) or against them, roughly as log odds, so that
// all evidence can be added up.

/// Green, autumn and blossom against brown and grey.
double colour_evidence(Vec3f linear);

/// Holes in the texture, where the triangles use it.
double alpha_evidence(const Appearance& look, AlphaMode mode, bool image_unread);

/// Many small flat pieces or lobes against tubes and level ground.
double shape_evidence(const Appearance& look, std::size_t instances);

/// High up, where crowns are, against low down. @param height of the middle: 0 at the foot of
/// everything in the file, 1 at the top.
double place_evidence(double height);

}  // namespace leafhull
