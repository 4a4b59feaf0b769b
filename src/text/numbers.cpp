// SPDX-License-Identifier: Apache-2.0
#include "text/numbers.h"

#include <array>
#include <cstdio>

namespace leafhull {
namespace {

std::string print(const char* format, int digits, double value) {
  std::array<char, 400> text;  // the largest double has 309 digits before the point
  std::snprintf(text.data(), text.size(), format, digits, value);
  return text.data();
}

}  // namespace

std::string shortest(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string significant(double value, int digits) { return print("%.*g", digits, value); }

std::string fixed(double value, int decimals) { return print("%.*f", decimals, value); }

std::string grouped(std::uint64_t count) { return grouped(std::to_string(count)); }

std::string grouped(std::string digits) {
  const std::ptrdiff_t first = digits.starts_with('-') ? 1 : 0;
  for (std::ptrdiff_t at = std::ssize(digits) - 3; at > first; at -= 3) {
    digits.insert(static_cast<std::size_t>(at), 1, ',');
  }
  return digits;
}

}  // namespace leafhull
