// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {

/// A part of a tree: its leaves, or all that is none; coarser levels of detail are left out.
struct TreePart {
  std::shared_ptr<const TreeModel> model;  ///< the tree, with more primitives where some are cut
  std::vector<Instance> instances;         ///< of its primitives, with triangles
};

/// What of a tree is no leaf.
/// @param choice of the tree's own instances.
TreePart rest_of(std::shared_ptr<const TreeModel> tree, const LeafChoice& choice);

/// What of a tree is leaves, as the file draws them.
/// @param choice of the tree's own instances.
TreePart leaves_of(std::shared_ptr<const TreeModel> tree, const LeafChoice& choice);

}  // namespace leafhull
