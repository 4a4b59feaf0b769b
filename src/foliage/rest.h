// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {

/// What of a tree is no leaf, coarser levels of detail left out.
struct Rest {
  std::shared_ptr<const TreeModel> model;  ///< the tree, with more primitives where some are cut
  std::vector<Instance> instances;         ///< of its primitives, with triangles
};

/// @param choice of the tree's own instances.
Rest rest_of(std::shared_ptr<const TreeModel> tree, const LeafChoice& choice);

}  // namespace leafhull
