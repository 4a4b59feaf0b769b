// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "leafhull/sweep.h"

namespace leafhull {

/// A page of the contact sheet.
struct Sheet {
  std::string file;  ///< contact-sheet.png; contact-sheet-07.png where there are several
  std::size_t begin = 0, end = 0;  ///< the combinations on it
};

/// Pages that picture viewers open, together every combination.
std::vector<Sheet> sheets(const SweepPlan& plan);

/// Pictures side by side: the values of the last swept option where they fit.
int sheet_columns(const SweepPlan& plan);

/// "birch.glb: threshold 1.5 to 2.5, method isotropic, controlled".
std::string sheet_title(const SweepPlan& plan, std::string_view tree);

}  // namespace leafhull
