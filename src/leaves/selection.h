// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {

/// Which of some instances are leaves, those of one primitive side by side; a pattern that matches
/// nothing is named in `warnings`.
/// @throws Error input where nothing matches.
std::vector<std::uint32_t> select_leaves(const TreeModel& tree, std::span<const Instance> instances,
                                         const LeafOptions& options,
                                         std::vector<std::string>& warnings);

}  // namespace leafhull
