// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "leafhull/series.h"
#include "leafhull/sweep.h"
#include "runs/sealed_json.h"

namespace leafhull {

/// A combination's line of the journal: parameters, counts, density, metrics and seconds as in a
/// report; null where it could not be computed, and then `failure` says why.
Json row_of(std::size_t combination, const std::string& picture, const SeriesEntry& entry);

/// Why a row's combination could not be computed; empty where it was.
std::string failure_of(const Json& row);

/// sweep.csv: a line per combination, the swept options first.
std::string csv(const SweepPlan& plan, const std::map<std::size_t, Json>& rows);

/// sweep.json, schema "leafhull-sweep/1". `identity` says which sweep it is.
std::string sweep_json(const Json& identity, const std::map<std::size_t, Json>& rows,
                       const RunDescription& run);

}  // namespace leafhull
