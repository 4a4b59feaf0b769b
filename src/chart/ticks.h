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

/// From zero, or from below where there are values below, to a round number at or above all
/// values. Values that are not finite do not count.
Axis value_axis(const std::vector<double>& values);

/// From the least to the greatest value with some room on both sides, marked at the values
/// themselves, or at every so many of few, where their texts fit; else at round numbers.
/// @param characters how many fit side by side along the axis
Axis parameter_axis(const std::vector<double>& values, double characters);

}  // namespace leafhull
