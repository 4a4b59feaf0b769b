// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>

#include "leafhull/series.h"
#include "leafhull/sweep.h"

namespace leafhull {
namespace {

constexpr double kCoverages[] = {0.85, 0.92, 0.98};
constexpr double kRadii[] = {1.5, 2.5, 4};  // crown units
constexpr int kPictureWidth = 320, kPictureHeight = 320;

std::vector<std::string> label(const Suggestion& choice) {
  char text[80];
  std::snprintf(text, sizeof text, "coverage %g, R_max %g", choice.coverage, choice.radius_max);
  const std::uint64_t components = choice.report.counts.components;
  return {text, choice.empty      ? "no surface"
                : components == 1 ? "1 component"
                                  : std::to_string(components) + " components"};
}

double volume(const Box& box) { return box.size().x * box.size().y * box.size().z; }

}  // namespace

Suggestions suggest(const LeafSet& leaves, const Options& options, Device& device,
                    std::string_view title, const Progress& progress) {
  Suggestions result;
  std::vector<Options> all;
  for (const double coverage : kCoverages) {
    for (const double radius_max : kRadii) {
      result.choices.push_back({.coverage = coverage, .radius_max = radius_max});
      all.push_back(options);
      all.back().coverage = coverage;
      all.back().radius_max = radius_max;
    }
  }

  const double largest = *std::max_element(std::begin(kRadii), std::end(kRadii));
  const Frame frame = frame_of(leaves, largest * leaves.bounds.longest_side() / kCrownUnits);
  std::vector<LabelledPicture> pictures(all.size());
  const SeriesVisitor visit = [&](std::size_t i, SeriesEntry&& entry) {
    Suggestion& choice = result.choices[i];
    choice.empty = entry.empty();
    choice.report = std::move(entry.report);
    const double side = choice.report.voxel_size;
    const auto voxels = static_cast<double>(choice.report.metrics.dilated_voxels);
    choice.dilated_volume = voxels * side * side * side;
    choice.dilated_share = choice.dilated_volume / volume(leaves.bounds);
    pictures[i].picture = draw_shape(entry.mesh, frame, kPictureWidth, kPictureHeight);
    pictures[i].lines = label(choice);
    return true;
  };
  extract_series(leaves, all, device, visit, progress);
  result.strip = contact_sheet(title, pictures, static_cast<int>(std::size(kRadii)));
  return result;
}

}  // namespace leafhull
