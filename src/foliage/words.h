// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "foliage/candidates.h"

namespace leafhull {

/// A name fit for a message of one line: control characters become ?, which also matches them.
std::string printable_name(std::string_view name);

/// What a candidate is called: by its material, else its mesh, else its node, and its colour where
/// it is a part.
std::string label(const LeafCandidate& candidate);

/// The option that takes a candidate as leaves.
std::string option_for(const LeafCandidate& candidate);

/// Lists the names in the file, and what comes nearest to leaves.
/// @throws Error input, always.
[[noreturn]] void throw_no_leaves(const TreeModel& tree, const LeafChoice& choice,
                                  const LeafOptions& options);

/// "Green (colour, shape)"
std::string taken_words(const std::vector<Candidate>& list);

/// "leaves: Green (colour, shape); passed over: Brown, Ground"
std::string told_words(const std::vector<Candidate>& list, const Levels& levels);

}  // namespace leafhull
