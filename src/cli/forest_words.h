// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace leafhull {
class Ranks;
}

namespace leafhull::cli {

/// What a forest's ranks say where a signal ends them: the first on its host to end tells which
/// others of it are lost, and how much is still to do. One object at a time.
class ForestWords {
 public:
  /// @param how_to_go_on one clause.
  ForestWords(Ranks& ranks, bool quiet, const std::string& how_to_go_on);
  ~ForestWords();
  ForestWords(const ForestWords&) = delete;
  ForestWords& operator=(const ForestWords&) = delete;

  void set_tiles(std::size_t tiles);  ///< how many there are in all, once they are counted
  /// How much is still to do, for a rank that an error ends: a sentence; empty before set_tiles().
  std::string still_to_do() const;
};

}  // namespace leafhull::cli
