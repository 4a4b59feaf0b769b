// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "leafhull/picture.h"

namespace leafhull {

/// The width of a row of `count` pictures of this width.
int row_width(int width, std::size_t count);

/// Pictures of one size in a row, white between them.
Picture side_by_side(std::span<const Picture> pictures);

}  // namespace leafhull
