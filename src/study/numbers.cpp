// SPDX-License-Identifier: Apache-2.0
#include "study/numbers.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace leafhull {
namespace {

std::string print(const char* format, int digits, double value) {
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), format, digits, value);
  return text.data();
}

}  // namespace

std::string grouped(std::uint64_t count) {
  std::string text = std::to_string(count);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3) {
    text.insert(static_cast<std::size_t>(at), ",");
  }
  return text;
}

std::string gained(double count) {
  const double size = std::fabs(count);
  const bool whole = size >= 10 || size == std::floor(size);
  const std::string text =
      whole ? grouped(static_cast<std::uint64_t>(std::llround(size))) : fixed(size, 1);
  return text + (count < 0 ? " fewer" : " more");
}

std::string shortest(double value) { return print("%.*g", 4, value); }

std::string fixed(double value, int digits) { return print("%.*f", digits, value); }

std::string percent(double share) {
  const double value = 100 * share;
  const bool near_an_end = std::fabs(value) < 10 || std::fabs(value - 100) < 10;
  return fixed(value, near_an_end ? 1 : 0) + "%";
}

}  // namespace leafhull
