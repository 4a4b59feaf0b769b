// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "leafhull/sweep.h"
#include "runs/sealed_json.h"

namespace leafhull {

inline constexpr std::string_view kJournalSchema = "leafhull-sweep-journal/2";

/// The identity of a sweep: the leaves, leafhull's version, the device, and the values of every
/// option over all combinations.
Json identity(const LeafSet& leaves, const SweepPlan& plan, const DeviceInfo& device);

/// @throws Error usage: `there`, the identity of the sweep in `folder`, is not `here`; the first
/// difference is named.
void check_same_sweep(const Json& there, const Json& here, const std::filesystem::path& folder);

bool takes_number(const OptionRow& row);

/// A number, perhaps with %, as swept_option() writes it in a list.
/// @throws Error usage: `text` is not a number.
SweptOption swept_number(const OptionRow& row, const std::string& text);

/// Reads a value of a swept option into its member. resolve() checks ranges.
/// @throws Error usage: `text` is not a number, or not one of the names.
void set_swept(Options& options, const OptionRow& row, const std::string& text);

/// The values of the swept options in a combination.
std::vector<std::string_view> values_of(const SweepPlan& plan, std::size_t combination);

/// "threshold 1.5, radius-max 4": the swept options of a combination with their values.
std::vector<std::string> labels(const SweepPlan& plan, std::size_t combination);

/// "0007-threshold-1.5-radius-max-4.png": names that sort as the combinations do.
std::string picture_name(const SweepPlan& plan, std::size_t combination);

}  // namespace leafhull
