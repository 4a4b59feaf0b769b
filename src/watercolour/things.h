// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "render/buffers.h"
#include "watercolour/style.h"

namespace leafhull::watercolour {

/// What of a picture is no foliage and has one kind of colour.
struct Thing {
  std::optional<Vec3f> colour;  ///< linear, mean; none: wood, brown or grey
  std::vector<float> coverage;  ///< of each pixel, 0..1; they add up to Buffers::wood
};

/// Wood first, then what has a hue of its own: a lake, a lawn, a glazed pot; at most one a sector
/// of the colour wheel.
std::vector<Thing> things_of(const render::Buffers& buffers);

/// A wash in the hue of a thing; how light it is stays the style's.
Wash hued(Wash wash, Vec3f linear);

}  // namespace leafhull::watercolour
