// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "leaves/sheets.h"

namespace leafhull {

/// Points of equal area on the visible part of a chart, row by row: those of a grid over its box
/// that lie in a triangle. There are at least `least`; a chart without extent gives its middle.
std::vector<Vec2d> even_samples(const LeafChart& chart, std::size_t least);

}  // namespace leafhull
