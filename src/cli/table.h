// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace leafhull::cli {

/// Rows in aligned columns, the first row being the heads. Numbers are right-aligned.
std::string table(const std::vector<std::vector<std::string>>& rows);

}  // namespace leafhull::cli
