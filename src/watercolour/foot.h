// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "render/buffers.h"

namespace leafhull::watercolour {

/// Where a tree stands in a picture, and half the width of what is seen of it; pixels.
struct Foot {
  float x, y, reach;
};

/// None where no wood reaches the ground within the picture, or where one looks down on it.
std::optional<Foot> find_foot(const render::Buffers& buffers);

}  // namespace leafhull::watercolour
