// SPDX-License-Identifier: Apache-2.0
// A case in leafhull's own terms.
#pragma once

#include <string>

#include "bench/contender.h"
#include "leafhull/leaves.h"
#include "leafhull/options.h"
#include "leafhull/tree.h"

namespace leafhull::bench {

/// A tree file, or a synthetic crown where `tree` is synthetic:COUNT.
TreeModel load_tree(const std::string& tree);

/// The leaves of that tree.
LeafSet load_leaves(const std::string& tree);

/// The case's radius, voxel size and threshold, resolved.
Options options_of(const Case& c, Method method);

/// Adds --method isotropic|controlled.
void add_method(CLI::App& app, Method& method);

}  // namespace leafhull::bench
