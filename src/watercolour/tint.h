// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/vec.h"
#include "watercolour/style.h"

namespace leafhull::watercolour {

/// A style for leaves of another colour than the green that styles are made for. The pigments of
/// the foliage turn in hue as far as the leaves do, and their chroma changes along; their lightness
/// stays. Shadows turn half as far.
/// @param leaves linear.
Style tinted(Style style, Vec3f leaves);

}  // namespace leafhull::watercolour
