// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>

#include "leafhull/options.h"

namespace leafhull::test {

/// The row of option_table() with that name, which must exist.
inline const OptionRow& option_row(std::string_view name) {
  const auto rows = option_table();
  return *std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.name == name; });
}

}  // namespace leafhull::test
