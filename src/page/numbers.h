// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace leafhull {

std::string count_text(std::uint64_t count);            ///< 52648 as "52,648"
std::string fixed_text(double value, int digits);       ///< a dash where it is not finite
std::string shortest_text(double value);                ///< 1.75 as "1.75", 2.0 as "2"
std::string share_text(std::uint64_t part, std::uint64_t whole);  ///< "18.2%"; a dash of nothing

}  // namespace leafhull
