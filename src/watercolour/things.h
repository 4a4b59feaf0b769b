// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "render/buffers.h"
#include "watercolour/style.h"

namespace leafhull::watercolour {

/// A part of a picture that is not foliage and has one kind of colour.
struct Thing {
  std::optional<Vec3f> colour;  ///< linear, mean; none: wood, brown or grey
  std::vector<float> coverage;  ///< of each pixel, 0..1; all things add up to Buffers::wood
};

/// Wood first, then things with a hue of their own, such as a lake, a lawn or a glazed pot: at most
/// one per sector of the colour wheel.
std::vector<Thing> things_of(const render::Buffers& buffers);

/// A wash in the hue of a thing, with the lightness of the style.
Wash hued(Wash wash, Vec3f linear);

}  // namespace leafhull::watercolour
