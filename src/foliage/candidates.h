// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "foliage/appearance.h"
#include "foliage/levels.h"
#include "foliage/names.h"
#include "leafhull/leaves.h"
#include "leaves/leaf_components.h"

namespace leafhull {

/// A candidate, and where in the tree it is.
struct Candidate {
  LeafCandidate told;
  Growth growth = Growth::unknown;  ///< what its names say it is
  std::optional<Vec3f> colour;      ///< linear, mean of what is visible
  double visible = 0;               ///< area that is not cut away, model units squared
  double height = 0;                ///< the height of its middle in the box of everything
  std::uint32_t primitive = 0;
  std::uint8_t part = 0;
  std::vector<std::uint32_t> instances;  ///< into those given; shared by the parts of a primitive
};

/// Everything in a file that could be leaves, with what speaks for it.
struct Candidates {
  std::vector<Candidate> list;                     ///< in file order
  std::vector<std::vector<std::uint8_t>> part_of;  ///< by primitive and triangle; empty: one part
  LeafChoice::Welded welded;
};

/// Finds candidates among the instances that `levels` keeps. @param looked_at by instance, whether
/// the options allow it; it is the same for all instances of a candidate.
Candidates find_candidates(const TreeModel& tree, std::span<const Instance> instances,
                           const Levels& levels, const std::vector<bool>& looked_at);

}  // namespace leafhull
