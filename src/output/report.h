// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "leafhull/output.h"

namespace leafhull {

/// Every option by the name of its flag, with underscores.
nlohmann::ordered_json options_object(const Options& options);

/// Seconds by stage; a stage that ran more than once is one.
nlohmann::ordered_json seconds_object(const std::vector<StageTime>& times);

/// The report as `report_json` prints it.
nlohmann::ordered_json report_object(const Report& report, const RunDescription& run);

}  // namespace leafhull
