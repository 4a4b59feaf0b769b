// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace leafhull {

/// Plain text as HTML, symbols as in print: R_max and lambda_R with indices below the line.
std::string typeset(std::string text);

}  // namespace leafhull
