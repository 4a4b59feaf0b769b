// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "text/numbers.h"

namespace leafhull {

std::string gained(double count);  ///< 1,234 more or 1.5 fewer; a decimal below 10
/// A share in percent, with a decimal near 0 and 100, where a whole number would hide on which side
/// of these it lies.
std::string percent(double share);

}  // namespace leafhull
