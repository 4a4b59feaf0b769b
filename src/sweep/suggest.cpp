// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "leafhull/series.h"
#include "leafhull/sweep.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

constexpr std::array kErosions{0.02, 0.12, 0.25};
/// Radii in crown units; shapes with these tell which dilations a tree can have.
constexpr std::array kRadii{1.5, 3.5, 9.0};
/// Neighbours whose volumes differ by less than this factor also differ in erosion, by this step.
constexpr double kClearlyLarger = 1.15, kErosionStep = 0.05;
constexpr int kPictureEdge = 320;

std::string percent(double share) { return significant(100 * share, 3) + "%"; }

std::vector<std::string> label(const Suggestion& choice) {
  const std::uint64_t pieces = choice.report.counts.components;
  return {"erosion " + percent(choice.erosion) + ", dilation " + percent(choice.dilation),
          !choice.failure.empty() ? "out of reach"
          : choice.empty
              ? "no surface"
              : "R_max " + significant(choice.report.options.radius_max.value_or(0), 3) + ", " +
                    std::to_string(pieces) + (pieces == 1 ? " component" : " components")};
}

double volume(const Box& box) { return box.size().x * box.size().y * box.size().z; }

struct DilationRange {
  double least = 1, most = 0;
  /// The dilation `share` of the way from the least, at equal factors of volume. A shape's voxels
  /// with a leaf stay the same, so its volume varies as 1 / (1 - D).
  double at(double share) const {
    const double empty = std::pow(1 - least, 1 - share) * std::pow(1 - most, share);
    return std::round(1000 * (1 - empty)) / 1000;
  }
  bool tells_apart() const { return (1 - least) > kClearlyLarger * kClearlyLarger * (1 - most); }
};

/// The range of dilations that goes with each erosion.
std::vector<DilationRange> ranges(const LeafSet& leaves, const Options& options,
                                  const std::vector<double>& erosions, Device& device,
                                  const Progress& progress) {
  std::vector<Options> all;
  for (const double erosion : erosions) {
    for (const double radius : kRadii) {
      all.push_back(options);
      all.back().erosion = erosion;
      all.back().radius_max = radius;
    }
  }
  std::vector<DilationRange> found(erosions.size());
  const SeriesVisitor visit = [&](std::size_t i, SeriesEntry&& entry) {
    if (!entry.failure.empty() || entry.empty()) return true;
    DilationRange& range = found[i / kRadii.size()];
    range.least = std::min(range.least, entry.report.metrics.dilation);
    range.most = std::max(range.most, entry.report.metrics.dilation);
    return true;
  };
  extract_series(leaves, all, device, visit, progress);
  for (DilationRange& range : found) {
    if (range.least > range.most) range = {0.5, 0.5};  // no shape has this erosion: tried, and told
  }
  return found;
}

/// The suggestions: a row for each erosion, dilations rising along it.
std::vector<Suggestion> choices(const LeafSet& leaves, const Options& options, Device& device,
                                const Progress& progress) {
  constexpr std::size_t kColumns = kRadii.size();
  const std::vector<double> rows(kErosions.begin(), kErosions.end());
  const std::vector<DilationRange> of_rows = ranges(leaves, options, rows, device, progress);
  std::vector<double> erosions;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t column = 0; column < kColumns; ++column) {
      const double more = of_rows[row].tells_apart() ? 0 : kErosionStep;
      erosions.push_back(rows[row] + more * static_cast<double>(kColumns - 1 - column));
    }
  }
  std::vector<double> different = erosions;
  different.erase(std::unique(different.begin(), different.end()), different.end());
  const std::vector<DilationRange> known = ranges(leaves, options, different, device, progress);
  std::vector<Suggestion> result(erosions.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double share = static_cast<double>(i % kColumns) / (kColumns - 1);
    const auto at = std::ranges::find(different, erosions[i]) - different.begin();
    result[i].erosion = erosions[i];
    result[i].dilation = known[static_cast<std::size_t>(at)].at(share);
  }
  return result;
}

}  // namespace

Suggestions suggest(const LeafSet& leaves, const Options& options, Device& device,
                    std::string_view title, const Progress& progress) {
  Suggestions result;
  result.choices = choices(leaves, options, device, progress);
  std::vector<Options> all;
  for (const Suggestion& choice : result.choices) {
    all.push_back(options);
    all.back().erosion = choice.erosion;
    all.back().dilation = choice.dilation;
  }

  const double crown_unit = leaves.crown.longest_side() / kCrownUnits;
  const Frame frame = frame_of(leaves, kRadii.back() / 2 * crown_unit);
  std::vector<LabelledPicture> pictures(all.size());
  const SeriesVisitor visit = [&](std::size_t i, SeriesEntry&& entry) {
    Suggestion& choice = result.choices[i];
    choice.failure = entry.failure;
    choice.empty = entry.empty();
    choice.report = std::move(entry.report);
    const double side = choice.report.voxel_size;
    const auto voxels = static_cast<double>(choice.report.metrics.dilated_voxels);
    choice.dilated_volume = voxels * side * side * side;
    if (volume(leaves.crown) > 0) {
      choice.dilated_share = choice.dilated_volume / volume(leaves.crown);
    }
    pictures[i].picture = draw_shape(entry.mesh, frame, kPictureEdge, kPictureEdge);
    pictures[i].lines = label(choice);
    return true;
  };
  extract_series(leaves, all, device, visit, progress);
  result.strip = contact_sheet(title, pictures, static_cast<int>(kRadii.size()));
  return result;
}

}  // namespace leafhull
