// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "leaves/sheets.h"

namespace leafhull {

/// Points of equal area on what is visible of a chart, row by row: those of a grid over its box
/// that lie in one of its triangles. At least `least`, where it has any extent; else its middle.
std::vector<Vec2d> even_samples(const LeafChart& chart, std::size_t least);

}  // namespace leafhull
