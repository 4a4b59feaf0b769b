// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {

/// A part of a tree: its leaves or everything else, without coarser levels of detail.
struct TreePart {
  std::shared_ptr<const TreeModel> model;  ///< the tree, with more primitives where some are cut
  std::vector<Instance> instances;         ///< of its primitives, with triangles
};

/// Everything in a tree except its leaves.
/// @param choice of the tree's own instances.
TreePart rest_of(std::shared_ptr<const TreeModel> tree, const LeafChoice& choice);

/// The leaves of a tree as the file draws them.
/// @param choice of the tree's own instances.
TreePart leaves_of(std::shared_ptr<const TreeModel> tree, const LeafChoice& choice);

}  // namespace leafhull
