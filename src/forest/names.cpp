// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "leafhull/forest.h"

namespace leafhull {

std::span<const std::string_view> names(Merge) {
  static constexpr std::array<std::string_view, 2> kNames{"none", "canopy"};
  return kNames;
}

std::span<const std::string_view> names(ControlScope) {
  static constexpr std::array<std::string_view, 2> kNames{"model", "scene"};
  return kNames;
}

}  // namespace leafhull
