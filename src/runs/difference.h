// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runs/sealed_json.h"

namespace leafhull {

/// A difference between two runs.
struct Difference {
  std::vector<std::string> path;  ///< keys and places in lists, from the outermost on
  Json there, here;               ///< discarded: missing

  /// "scene.file is "a" there and "b" here".
  std::string text() const;
};

/// The first difference in the order in which `here` lists its members.
std::optional<Difference> first_difference(const Json& there, const Json& here);

}  // namespace leafhull
