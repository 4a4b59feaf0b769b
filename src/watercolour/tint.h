// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/vec.h"
#include "watercolour/style.h"

namespace leafhull::watercolour {

/// A style for leaves of another colour than the green that styles are made for: the hue of the
/// foliage's pigments turns by as much as the leaves' does, and their chroma goes with it; how
/// light they are stays the painter's. Shadows turn half as far.
/// @param leaves linear.
Style tinted(Style style, Vec3f leaves);

}  // namespace leafhull::watercolour
