// SPDX-License-Identifier: Apache-2.0
#include "text/numbers.h"

#include <algorithm>
#include <array>

namespace leafhull {
namespace {

/// As std::to_chars writes it: as printf in the C locale, whatever the locale is.
template <class... Form>
std::string printed(double value, Form... form) {
  std::array<char, 400> text;  // the largest double has 309 digits before the point
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, form...).ptr};
}

}  // namespace

std::string shortest(double value) { return printed(value); }

std::string significant(double value, int digits) {
  return printed(value, std::chars_format::general, digits);
}

std::string fixed(double value, int decimals) {
  return printed(value, std::chars_format::fixed, decimals);
}

std::string grouped(std::uint64_t count) { return grouped(std::to_string(count)); }

std::string grouped(std::string number) {
  const std::ptrdiff_t first = number.starts_with('-') ? 1 : 0;
  const auto end = std::min(number.find_first_of(".e"), number.size());
  for (auto at = static_cast<std::ptrdiff_t>(end) - 3; at > first; at -= 3) {
    number.insert(static_cast<std::size_t>(at), 1, ',');
  }
  return number;
}

}  // namespace leafhull
