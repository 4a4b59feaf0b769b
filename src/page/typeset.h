// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace leafhull {

/// Plain text as HTML with symbols as in print: the indices of R_max and lambda_R are subscripts.
std::string typeset(std::string text);

}  // namespace leafhull
