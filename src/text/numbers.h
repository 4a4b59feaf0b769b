// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace leafhull {

std::string shortest(double value);                 ///< the fewest digits that give the same number
std::string significant(double value, int digits);  ///< at most `digits` significant digits
std::string fixed(double value, int decimals);      ///< so many digits after the point
std::string grouped(std::uint64_t count);           ///< 1,234,567
std::string grouped(std::string number);            ///< 1,234,567; -1,234.5

/// The number that the whole text is, which may be inf or nan; none where it is anything else.
template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace leafhull
