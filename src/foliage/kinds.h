// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "foliage/candidates.h"

namespace leafhull {

/// Needles of conifers, fronds of palms or broad leaves, where a name holds a word for them.
std::optional<LeafKind> read_kind(std::string_view name);

/// What most of the chosen leaves are, by area: as the names of material, mesh, image and node say,
/// or of a node above, or of the file; broad where none does.
LeafKind kind_of(const TreeModel& tree, std::span<const Instance> instances,
                 const std::vector<Candidate>& candidates);

}  // namespace leafhull
