// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "leafhull/output.h"

namespace leafhull {

/// The report as `report_json` prints it.
nlohmann::ordered_json report_object(const Report& report, const RunDescription& run);

/// Every option of option_table() by its name.
nlohmann::ordered_json option_values(const Options& options);

}  // namespace leafhull
