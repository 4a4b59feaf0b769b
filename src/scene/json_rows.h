// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "scene/scatter_row.h"

namespace leafhull {

/// Reads the lines of a .jsonl file one after the other, each an object.
class JsonRows {
 public:
  /// @returns true. @throws BadRow.
  bool read(std::string& line, ScatterRow& row);

  /// Names of the members that were ignored, for a warning; else empty.
  std::string passed_over() const;

 private:
  std::set<std::string> unknown_;
};

}  // namespace leafhull
