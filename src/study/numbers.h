// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace leafhull {

std::string grouped(std::uint64_t count);  ///< 1,234,567
std::string gained(double count);          ///< 1,234 more or 1.5 fewer; a decimal below 10
std::string shortest(double value);        ///< at most four significant digits
std::string fixed(double value, int digits);
/// A share in percent, with a decimal near 0 and 100, where a whole number would hide on which side
/// of these it lies.
std::string percent(double share);

}  // namespace leafhull
