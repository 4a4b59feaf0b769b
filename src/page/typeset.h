// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace leafhull {

/// Plain text as HTML, R_max and lambda_R with their indices set below the line.
std::string typeset(const std::string& text);

}  // namespace leafhull
