// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace leafhull::cli {

/// Rows in columns of equal width, the first row the heads. Numbers are set to the right.
std::string table(const std::vector<std::vector<std::string>>& rows);

}  // namespace leafhull::cli
