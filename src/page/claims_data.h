// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "leafhull/study.h"

namespace leafhull {

/// An outcome and its wording.
nlohmann::json mark(Outcome outcome);

/// The summary: each claim with its outcome on every tree in the first reading, and in how many
/// readings it holds there.
nlohmann::json claims_data(const Study& study);

/// The verdicts of one tree, reading by reading.
nlohmann::json readings_data(const TreeStudy& tree);

}  // namespace leafhull
