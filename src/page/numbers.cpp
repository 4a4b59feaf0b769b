// SPDX-License-Identifier: Apache-2.0
#include "page/numbers.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace leafhull {
namespace {

constexpr const char* kDash = "\u2013";

template <class... Format>
std::string to_text(double value, Format... format) {
  if (!std::isfinite(value)) return kDash;
  std::array<char, 400> digits;  // the longest double in fixed notation has 309 before the point
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, format...);
  return error == std::errc() ? std::string(digits.data(), end) : kDash;
}

}  // namespace

std::string count_text(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, ",");
  return text;
}

std::string fixed_text(double value, int digits) {
  return to_text(value, std::chars_format::fixed, digits);
}

std::string shortest_text(double value) { return to_text(value); }

std::string share_text(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return kDash;
  return fixed_text(100 * static_cast<double>(part) / static_cast<double>(whole), 1) + "%";
}

}  // namespace leafhull
