// SPDX-License-Identifier: Apache-2.0
#include "points/samples.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "points/even_samples.h"

namespace leafhull {
namespace {

/// This many give T for a coverage of 0.98 to within a percent. With fewer, the surface would
/// depend on how leaves happen to be tessellated.
constexpr std::size_t kSamples = 1 << 15;
/// The least number of places on a chart to choose from.
constexpr std::size_t kLeastPlaces = 64;

/// The samples of one leaf, [first, end). Samples lie at equal steps of the area, leaf by leaf.
struct Taken {
  std::size_t sheet, first, end;
  double before;  ///< the area of the leaves before
};

/// The leaves whose middle lies in `crown`, or all where none does.
std::vector<std::size_t> leaves_in(const LeafSet::Sheets& sheets, const Box& crown) {
  std::vector<std::size_t> within, all;
  for (std::size_t i = 0; i < sheets.sheets.size(); ++i) {
    const LeafSheet& sheet = sheets.sheets[i];
    all.push_back(i);
    if (crown.contains(sheet.at(sheets.charts[sheet.chart].centre))) within.push_back(i);
  }
  return within.empty() ? all : within;
}

std::vector<Taken> leaves_with_samples(const LeafSet::Sheets& sheets,
                                       std::span<const std::size_t> leaves, double step) {
  std::vector<Taken> taken;
  double before = 0;
  std::size_t first = 0;
  for (const std::size_t i : leaves) {
    const double after = before + sheets.sheets[i].area;
    const bool last = i == leaves.back();
    const std::size_t end =
        last ? kSamples
             : std::min(kSamples,
                        static_cast<std::size_t>(std::llround(std::floor(after / step + 0.5))));
    if (end > first) taken.push_back({i, first, end, before});
    first = std::max(first, end);
    before = after;
  }
  return taken;
}

}  // namespace

Samples samples_of(const LeafSet::Sheets& sheets, const Box& crown) {
  const std::vector<std::size_t> leaves = leaves_in(sheets, crown);
  double area = 0;
  for (const std::size_t i : leaves) area += sheets.sheets[i].area;
  const double step = area / static_cast<double>(kSamples);
  const std::vector<Taken> taken = leaves_with_samples(sheets, leaves, step);
  std::vector<std::size_t> wanted(sheets.charts.size(), 0);
  for (const Taken& t : taken) {
    std::size_t& places = wanted[sheets.sheets[t.sheet].chart];
    places = std::max({places, kLeastPlaces, 2 * (t.end - t.first)});
  }
  std::vector<std::vector<Vec2d>> places(sheets.charts.size());
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t c) {
    if (wanted[c] > 0) places[c] = even_samples(sheets.charts[c], wanted[c]);
  });
  Samples samples;
  samples.places.reserve(kSamples);
  samples.sheet.reserve(kSamples);
  for (const Taken& t : taken) {
    const LeafSheet& sheet = sheets.sheets[t.sheet];
    const std::vector<Vec2d>& on_chart = places[sheet.chart];
    for (std::size_t i = t.first; i < t.end; ++i) {
      // The share of the leaf's area that lies before the sample.
      const double into = ((static_cast<double>(i) + 0.5) * step - t.before) / sheet.area;
      const auto place = static_cast<std::size_t>(std::clamp(into, 0.0, 1.0) *
                                                  static_cast<double>(on_chart.size()));
      samples.places.push_back(sheet.at(on_chart[std::min(place, on_chart.size() - 1)]));
      samples.sheet.push_back(static_cast<std::uint32_t>(t.sheet));
    }
  }
  return samples;
}

}  // namespace leafhull
