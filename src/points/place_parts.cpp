// SPDX-License-Identifier: Apache-2.0
#include "points/place_parts.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "leafhull/error.h"
#include "points/cut.h"
#include "points/ellipse_of.h"
#include "points/even_samples.h"
#include "points/leaf_points.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

constexpr std::size_t kMostParts = 10'000'000;
/// Samples of a chart for each part that is cut from it.
constexpr std::size_t kSamplesPerPart = 40;
/// Steps per doubling in which the proportions of leaves are compared.
constexpr double kProportionSteps = 16;
constexpr double kMostDoublings = 20;
/// A strip of length L has R_u = L / sqrt 3; no part is longer than twice the spacing.
const double kLengthOverRadius = std::sqrt(3.0);
constexpr double kLongest = 2;

Eigen::Vector3d to_eigen(const Vec3d& v) { return {v.x, v.y, v.z}; }

/// The number of parts that a leaf is cut into. Rounding does not add one.
double parts_of(const LeafSheet& sheet, double spacing) {
  const double by_area = std::ceil(sheet.area / (spacing * spacing) * (1 - 1e-9));
  const double length = kLengthOverRadius * static_cast<double>(sheet.radius_major);
  return std::max({1.0, by_area, std::ceil(length / (kLongest * spacing))});
}

/// What decides how a leaf is cut: its chart, the number of its parts, and the proportions in which
/// the chart's axes stand in space, as in [1 shear; 0 height].
struct Cut {
  std::uint32_t chart;
  std::size_t count;
  int shear, log_height;  // in steps
  auto operator<=>(const Cut&) const = default;

  static Cut of(const LeafSheet& sheet, std::size_t count) {
    const Vec3d x = sheet.across, y = sheet.along;
    const double width = length(x), skew = dot(x, y) / width;
    const double height = std::sqrt(std::max(dot(y, y) - skew * skew, 0.0));
    const auto steps = [](double v) {  // bounded even for slivers
      const double most = kMostDoublings * kProportionSteps;
      if (!std::isfinite(v)) return 0;
      return static_cast<int>(std::lround(std::clamp(kProportionSteps * v, -most, most)));
    };
    return {sheet.chart, count, steps(skew / height), steps(std::log2(height / width))};
  }

  /// Maps the chart to a plane in which lengths are as in space, up to scale.
  Eigen::Matrix2d to_plane() const {
    const double height = std::exp2(log_height / kProportionSteps);
    Eigen::Matrix2d map;
    map << 1, shear / kProportionSteps * height, 0, height;
    return map;
  }
};

/// Parts in the chart's own coordinates.
std::vector<FlatPart> cut_chart(const LeafChart& chart, const Cut& cut) {
  const Eigen::Matrix2d to_plane = cut.to_plane();
  std::vector<Eigen::Vector2d> samples;
  for (const Vec2d p : even_samples(chart, cut.count * kSamplesPerPart)) {
    samples.emplace_back(to_plane * Eigen::Vector2d(p.x, p.y));
  }
  std::vector<FlatPart> parts = cut_evenly(samples, cut.count);
  const Eigen::Matrix2d back = to_plane.inverse();
  for (FlatPart& part : parts) {
    part.centre = back * part.centre;
    part.moments = back * part.moments * back.transpose();
  }
  return parts;
}

/// The one part of an uncut leaf, which keeps its own ellipse. A triangle of a curved surface is
/// treated like any other part.
LeafPoint whole(const LeafSheet& sheet, const LeafChart& chart, double spacing) {
  const auto least = static_cast<float>(sheet.piece ? kLeastRadius * spacing : 0);
  return {sheet.at(chart.centre),
          sheet.normal,
          sheet.major,
          std::max(sheet.radius_major, least),
          std::max(sheet.radius_minor, least),
          sheet.area};
}

LeafPoint placed(const FlatPart& part, const LeafSheet& sheet, double spacing) {
  Eigen::Matrix<double, 3, 2> axes;
  axes << to_eigen(sheet.across), to_eigen(sheet.along);
  const Eigen::Matrix3d moments = axes * part.moments * axes.transpose();
  const Vec3d centre = sheet.at({part.centre.x(), part.centre.y()});
  return ellipse_of(centre, part.share * sheet.area, to_eigen(Vec3d(sheet.normal)), moments,
                    kLeastRadius * spacing);
}

}  // namespace

std::vector<LeafPoint> place_parts(const LeafSheets& sheets, double spacing,
                                   const std::function<bool(const LeafSheet&)>& is_out) {
  double all = 0;
  std::map<Cut, std::vector<FlatPart>> cuts;
  for (const LeafSheet& sheet : sheets.sheets) {
    if (is_out(sheet)) continue;
    const double count = parts_of(sheet, spacing);
    if (count > 1) all += count;
    if (!(all <= kMostParts)) continue;
    if (count > 1) cuts.try_emplace(Cut::of(sheet, static_cast<std::size_t>(count)));
  }
  if (!(all <= kMostParts)) {
    throw Error(ErrorCode::usage,
                "the leaves would be cut into " + significant(all, 3) + " parts of " +
                    significant(spacing, 3) + " model units, more than ten million",
                "Raise --radius-max or --point-spacing.");
  }
  std::vector<std::pair<const Cut, std::vector<FlatPart>>*> jobs;
  for (auto& entry : cuts) jobs.push_back(&entry);
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    jobs[i]->second = cut_chart(sheets.charts[jobs[i]->first.chart], jobs[i]->first);
  });

  std::vector<LeafPoint> points;
  points.reserve(sheets.sheets.size() + static_cast<std::size_t>(all));
  for (const LeafSheet& sheet : sheets.sheets) {
    if (is_out(sheet)) continue;
    const double count = parts_of(sheet, spacing);
    if (count == 1) {
      points.push_back(whole(sheet, sheets.charts[sheet.chart], spacing));
      continue;
    }
    for (const FlatPart& part : cuts.at(Cut::of(sheet, static_cast<std::size_t>(count)))) {
      points.push_back(placed(part, sheet, spacing));
    }
  }
  return points;
}

}  // namespace leafhull
