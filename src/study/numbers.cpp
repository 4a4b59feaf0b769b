// SPDX-License-Identifier: Apache-2.0
#include "study/numbers.h"

#include <cmath>

namespace leafhull {

std::string gained(double count) {
  const double size = std::fabs(count);
  const bool whole = size >= 10 || size == std::floor(size);
  const std::string text =
      whole ? grouped(static_cast<std::uint64_t>(std::llround(size))) : fixed(size, 1);
  return text + (count < 0 ? " fewer" : " more");
}

std::string percent(double share) {
  const double value = 100 * share;
  const bool near_an_end = std::fabs(value) < 10 || std::fabs(value - 100) < 10;
  return fixed(value, near_an_end ? 1 : 0) + "%";
}

}  // namespace leafhull
