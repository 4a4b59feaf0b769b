// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace leafhull {

struct Tick {
  double value;
  std::string text;
};

/// An axis' range and its marks, which lie within it.
struct Axis {
  double low = 0, high = 1;
  std::vector<Tick> ticks;
};

/// An axis from zero (or from a round number below any negative value) to a round number at or
/// above all values. Values that are not finite do not count.
Axis value_axis(const std::vector<double>& values);

/// An axis from the least to the greatest value with some room on both sides. Marks are at the
/// values, or at every n-th of a few values, if their texts fit; else at round numbers.
/// @param characters the number of characters that fit along the axis
Axis parameter_axis(const std::vector<double>& values, double characters);

}  // namespace leafhull
