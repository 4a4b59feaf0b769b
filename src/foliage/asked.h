// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "foliage/candidates.h"
#include "leafhull/leaves.h"

namespace leafhull {

/// What the options --leaves, --not-leaves and --leaves-colour ask for.
class Asked {
 public:
  Asked(const TreeModel& tree, std::span<const Instance> instances, const LeafOptions& options);

  /// By instance, whether it may be leaves: named by --leaves, if that is given, and not by
  /// --not-leaves.
  const std::vector<bool>& candidates() const { return candidates_; }

  /// Takes what is asked for, whatever the evidence says.
  void choose(const Levels& levels, Candidates& candidates, LeafChoice& choice) const;

  /// Names patterns that match nothing.
  void warn_of_unused(std::vector<std::string>& warnings) const;

 private:
  void choose_by_colour(const Candidates& candidates, LeafChoice& choice) const;

  const TreeModel& tree_;
  const LeafOptions& options_;
  std::vector<bool> candidates_;
  std::vector<std::string> unused_;
};

}  // namespace leafhull
