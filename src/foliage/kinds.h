// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "foliage/candidates.h"

namespace leafhull {

/// Needles of conifers, fronds of palms or broad leaves, where a name holds a word for them.
std::optional<LeafKind> read_kind(std::string_view name);

/// The kind of most of the chosen leaves by area, from the names of material, mesh, image and node,
/// else of a node above, else of the file; broad if no name tells.
LeafKind kind_of(const TreeModel& tree, std::span<const Instance> instances,
                 const std::vector<Candidate>& candidates);

}  // namespace leafhull
