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

/// The pages, which hold every combination; each is small enough for picture viewers.
std::vector<Sheet> sheets(const SweepPlan& plan);

/// Pictures in a row: one for each value of the last swept option, where they fit.
int sheet_columns(const SweepPlan& plan);

/// "birch.glb: threshold 1.5 to 2.5, method isotropic, controlled".
std::string sheet_title(const SweepPlan& plan, std::string_view tree);

}  // namespace leafhull
