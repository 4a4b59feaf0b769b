// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "leafhull/leaves.h"
#include "leaves/sheets.h"

namespace leafhull {

/// The parts of every leaf, leaf by leaf: one that is small is one part with its own ellipse,
/// others are cut, once for all leaves that show the same chart in the same proportions. `is_out`:
/// leaves that are left out.
/// @throws Error usage: more than ten million parts.
std::vector<LeafPoint> place_parts(const LeafSet::Sheets& sheets, double spacing,
                                   const std::function<bool(const LeafSheet&)>& is_out);

}  // namespace leafhull
