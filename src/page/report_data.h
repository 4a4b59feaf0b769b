// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "leafhull/study.h"
#include "page/figures.h"

namespace leafhull {

/// What report.html shows, by the names of its tags: plain text, every number formatted. `false`
/// and what is empty leave their section out.
/// @param plots one for each tree, or none.
nlohmann::json report_data(const Study& study, std::span<const TreePlots> plots);

}  // namespace leafhull
