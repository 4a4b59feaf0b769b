// SPDX-License-Identifier: Apache-2.0
#include "text/choice.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "leafhull/error.h"

namespace leafhull {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::size_t choice(std::string_view flag, std::string_view text,
                   std::span<const std::string_view> valid) {
  const auto found = std::find(valid.begin(), valid.end(), text);
  if (found == valid.end()) {
    const std::string_view near = nearest(text, valid);
    const std::string guess = near.empty() ? "" : "Did you mean " + std::string(near) + "? ";
    throw Error(ErrorCode::usage, std::string(flag) + " '" + std::string(text) + "' is unknown",
                guess + "Choose from: " + joined(valid, ", ") + ".");
  }
  return static_cast<std::size_t>(found - valid.begin());
}

std::string_view nearest(std::string_view text, std::span<const std::string_view> valid) {
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(2, text.size() / 3) + 1;
  for (const std::string_view candidate : valid) {
    const std::size_t distance = edit_distance(text, candidate);
    if (distance < best_distance) best = candidate, best_distance = distance;
  }
  return best;
}

}  // namespace leafhull
