// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace leafhull {
class Ranks;
}

namespace leafhull::cli {

/// What a forest's ranks say when a signal ends them: the first on its host to end says which of
/// the others there are lost and how much is still to do. One object at a time.
class ForestWords {
 public:
  /// @param how_to_go_on one clause on how to continue.
  ForestWords(Ranks& ranks, bool quiet, const std::string& how_to_go_on);
  ~ForestWords();
  ForestWords(const ForestWords&) = delete;
  ForestWords& operator=(const ForestWords&) = delete;

  void set_tiles(std::size_t tiles);  ///< sets how many tiles there are, once counted
  /// A sentence on how much is still to do when an error ends a rank; empty before set_tiles().
  std::string still_to_do() const;
};

}  // namespace leafhull::cli
