// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>

#include "leafhull/error.h"
#include "leafhull/series.h"
#include "leafhull/sweep.h"

namespace leafhull {
namespace {

constexpr double kCoverages[] = {0.85, 0.92, 0.98};
constexpr double kRadii[] = {1.5, 2.5, 4};  // crown units, ascending
constexpr int kPictureWidth = 320, kPictureHeight = 320;

std::vector<std::string> label(const Suggestion& choice) {
  char text[80], result[80];
  std::snprintf(text, sizeof text, "coverage %g, R_max %g", choice.coverage, choice.radius_max);
  const auto components = static_cast<unsigned long long>(choice.report.counts.components);
  std::snprintf(result, sizeof result, "T = %.4g, %llu component%s", choice.report.threshold,
                components, components == 1 ? "" : "s");
  return {text, choice.empty ? "no surface" : result};
}

double volume(const Box& box) { return box.size().x * box.size().y * box.size().z; }

}  // namespace

Suggestions suggest(const LeafSet& leaves, const Options& options, Device& device,
                    std::string_view title, const Progress& progress) {
  Suggestions result;
  std::vector<Options> all;
  for (const double coverage : kCoverages) {
    for (const double radius_max : kRadii) {
      Suggestion& choice = result.choices.emplace_back();
      choice.coverage = coverage, choice.radius_max = radius_max;
      all.push_back(options);
      all.back().coverage = coverage;
      all.back().radius_max = radius_max;
    }
  }

  const Frame frame = frame_of(leaves, radius_max_in_model_units(leaves, all.back()));
  std::vector<LabelledPicture> pictures(all.size());
  const SeriesVisitor visit = [&](std::size_t i, SeriesEntry&& entry) {
    if (!entry.failure.empty()) throw Error(ErrorCode::usage, entry.failure);
    Suggestion& choice = result.choices[i];
    choice.empty = entry.empty();
    choice.report = std::move(entry.report);
    const double side = choice.report.voxel_size;
    const auto voxels = static_cast<double>(choice.report.metrics.dilated_voxels);
    choice.dilated_volume = voxels * side * side * side;
    if (volume(leaves.crown) > 0) {
      choice.dilated_share = choice.dilated_volume / volume(leaves.crown);
    }
    choice.covered = choice.report.covered;
    pictures[i].picture = draw_shape(entry.mesh, frame, kPictureWidth, kPictureHeight);
    pictures[i].lines = label(choice);
    return true;
  };
  extract_series(leaves, all, device, visit, progress);
  result.strip = contact_sheet(title, pictures, static_cast<int>(std::size(kRadii)));
  return result;
}

}  // namespace leafhull
