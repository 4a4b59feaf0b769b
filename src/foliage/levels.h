// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "leafhull/tree.h"

namespace leafhull {

/// Which instances are the same thing again, coarser: LOD1 beside LOD0, in the name of a node, of
/// one it hangs from or of a mesh; what MSFT_lod lists; a billboard beside what it stands for.
struct Levels {
  std::vector<bool> coarser;      ///< by instance
  std::vector<std::string> kept;  ///< names of the finest levels, where there are others
  std::size_t passed_over = 0;    ///< instances
};

/// @param looked_at by instance, whether it counts; others are never marked as coarser.
Levels find_levels(const TreeModel& tree, std::span<const Instance> instances,
                   const std::vector<bool>& looked_at);

}  // namespace leafhull
