// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <span>

#include "leafhull/study.h"
#include "page/figures.h"

namespace leafhull {

/// Writes the study as one self-contained HTML page.
/// @param plots one for each tree, or none.
void write_report(const Study& study, std::span<const TreePlots> plots, std::ostream& stream);

}  // namespace leafhull
