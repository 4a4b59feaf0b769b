// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "render/buffers.h"

namespace leafhull::watercolour {

/// Where a tree stands in a picture, and half the visible width of its foot; pixels.
struct Foot {
  float x, y, reach;
};

/// None if no wood reaches the ground within the picture, or if the camera looks down on it.
std::optional<Foot> find_foot(const render::Buffers& buffers);

}  // namespace leafhull::watercolour
