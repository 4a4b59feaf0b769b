// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "leafhull/picture.h"

namespace leafhull {

/// The width of so many pictures of this width in a row.
int row_width(int width, std::size_t count);

/// Pictures of one size in a row, white between them.
Picture side_by_side(std::span<const Picture> pictures);

}  // namespace leafhull
