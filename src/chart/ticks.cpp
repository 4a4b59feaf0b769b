// SPDX-License-Identifier: Apache-2.0
#include "chart/ticks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "text/numbers.h"

namespace leafhull {
namespace {

constexpr double kMillion = 1e6;
constexpr std::size_t kFewIntervals = 24;

/// 2.5, 40,000, and on an axis of millions 0.5 M.
std::string text_of(double value, bool in_millions) {
  in_millions &= std::abs(value) >= kMillion / 10;
  std::string result = significant(in_millions ? value / kMillion : value, 6);
  if (result.find_first_of(".e") == std::string::npos) result = grouped(std::move(result));
  return in_millions ? result + " M" : result;
}

/// 1, 2 or 5 times a power of ten, at least `least`.
double round_step(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= least * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

/// Multiples of `step` from `low` to `high`.
std::vector<Tick> multiples(double step, double low, double high) {
  const bool in_millions = std::max(-low, high) >= kMillion;
  const double first = std::ceil(low / step - 1e-9), last = std::floor(high / step + 1e-9);
  std::vector<Tick> ticks;
  for (int i = 0; i <= last - first; ++i) {
    const double value = (first + i) * step;
    ticks.push_back({value, text_of(value, in_millions)});
  }
  return ticks;
}

double longest_text(const std::vector<Tick>& ticks) {
  std::size_t longest = 0;
  for (const Tick& tick : ticks) longest = std::max(longest, tick.text.size());
  return static_cast<double>(longest);
}

/// Whether the texts stand apart by two characters on an axis as long as `characters`.
bool fit(const Axis& axis, double characters) {
  const double needed = (longest_text(axis.ticks) + 2) * (axis.high - axis.low) / characters;
  return std::adjacent_find(axis.ticks.begin(), axis.ticks.end(),
                            [&](const Tick& a, const Tick& b) {
                              return b.value - a.value < needed;
                            }) == axis.ticks.end();
}

std::vector<double> distinct_finite(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

Axis value_axis(const std::vector<double>& values) {
  constexpr int kSteps = 4;
  double low = 0, high = 0;
  for (const double value : distinct_finite(values)) {
    low = std::min(low, value), high = std::max(high, value);
  }
  if (low == high) high = 1;
  const double step = round_step((high - low) / kSteps);
  Axis axis{step * std::floor(low / step), step * std::ceil(high / step - 1e-9), {}};
  axis.ticks = multiples(step, axis.low, axis.high);
  return axis;
}

Axis parameter_axis(const std::vector<double>& values, double characters) {
  const std::vector<double> there = distinct_finite(values);
  if (there.empty()) return {};
  const double low = there.front(), high = there.back();
  const double room = high > low ? (high - low) * 0.05 : std::max(std::abs(low) / 2, 0.5);
  Axis axis{low - room, high + room, {}};
  const bool in_millions = std::max(-low, high) >= kMillion;
  const std::size_t intervals = there.size() - 1;
  for (std::size_t every = 1; every == 1 || (intervals <= kFewIntervals && 2 * every <= intervals);
       ++every) {
    if (intervals % every != 0) continue;
    axis.ticks.clear();
    for (std::size_t i = 0; i <= intervals; i += every) {
      axis.ticks.push_back({there[i], text_of(there[i], in_millions)});
    }
    if (fit(axis, characters)) return axis;
  }
  for (double step = round_step((high - low) / 64); !fit(axis, characters);
       step = round_step(step * 1.5)) {
    axis.ticks = multiples(step, low, high);
  }
  return axis;
}

}  // namespace leafhull
