// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>

namespace leafhull {

/// How far a call has come.
struct Advance {
  std::string_view stage;  ///< valid during the call
  double done = 0;         ///< the share of the stage, or of what the function says; 0 to 1
  bool is_even = false;    ///< `done` is the share of all the work and grows evenly with time
  /// How many frames, combinations, tiles or models are finished, of how many; 0 of 0 where the
  /// function does not count.
  std::size_t finished = 0, all = 0;
  /// Only told by run_forest: the leaf vertices in the tiles that this run has finished, and the
  /// memory that this process holds now.
  std::uint64_t leaf_vertices = 0, resident_bytes = 0;
};

/// Called when a stage starts and as it proceeds; calls never overlap.
using Progress = std::function<void(const Advance&)>;

}  // namespace leafhull
