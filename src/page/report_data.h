// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "leafhull/study.h"
#include "page/figures.h"

namespace leafhull {

/// The data for report.html by the names of its tags: plain text, every number formatted. Sections
/// whose data is `false` or empty are left out.
/// @param plots one for each tree, or none.
nlohmann::json report_data(const Study& study, std::span<const TreePlots> plots);

}  // namespace leafhull
