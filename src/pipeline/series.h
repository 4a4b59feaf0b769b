// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/series.h"

namespace leafhull {

/// Checks the options of a series, and what they mean on this tree, as extract_series() does first.
/// @throws Error as extract does for its options and the crown.
void check_series(const LeafSet& leaves, std::span<const Options> options);

}  // namespace leafhull
