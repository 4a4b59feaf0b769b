// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/forest.h"
#include "leafhull/ranks.h"

namespace leafhull {

/// Extracts every tree model once, as it stands alone, and writes forest.glb with all trees as
/// instances of these shapes. Rank 0 works, the others wait.
/// @throws Error as run_forest.
ForestSummary merge_none(const Scene& scene, const ForestOptions& options, Device& device,
                         Ranks& ranks, const std::filesystem::path& folder,
                         const Progress& progress);

}  // namespace leafhull
