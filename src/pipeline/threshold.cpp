// SPDX-License-Identifier: Apache-2.0
#include "pipeline/threshold.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "density/control.h"
#include "leafhull/error.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

std::vector<WeightedDensity> weighted(const LeafDensity& there) {
  const auto& [density, in_solid] = there;
  std::vector<WeightedDensity> all;
  all.reserve(density.size());
  for (std::size_t i = 0; i < density.size(); ++i) all.push_back({density[i], 1, in_solid[i]});
  return all;
}

/// T for a coverage.
double threshold_for(const ThresholdOptions& options, const LeafDensity& there) {
  const double threshold = threshold_for_coverage(there.density, *options.coverage);
  if (options.points != PointSource::area) return threshold;
  std::vector<WeightedDensity> all = weighted(there);
  return clear_of_sheets(all, threshold, *options.coverage);
}

/// The T that leaves the share `erosion` below it. Errors name the erosion in the options.
double threshold_for_erosion(const ThresholdOptions& options, double erosion,
                             const LeafDensity& there) {
  const std::span<const float> density = there.density;
  const double threshold = threshold_for_coverage(density, 1 - erosion);
  const std::string refused = "an erosion of " + significant(*options.erosion, 3);
  if (options.points == PointSource::area) {
    std::vector<WeightedDensity> all = weighted(there);
    if (const std::optional<double> whole = below_film(all, threshold)) {
      throw Error(ErrorCode::usage,
                  refused + " cannot be reached: most of this tree is sheets of one density, " +
                      significant(*whole / 0.6, 3) +
                      ", and a surface next to that is a film with holes; " +
                      significant(share_below(density, *whole), 3) + " can",
                  "Give that erosion, or --coverage in place of --erosion.");
    }
  }
  const double below = share_below(density, threshold);
  const double with_equal = share_below(density, std::nextafter(threshold, HUGE_VAL));
  if (std::abs(below - erosion) > kSliderError) {
    throw Error(ErrorCode::usage,
                refused + " cannot be reached: many leaf vertices have the density " +
                    significant(threshold, 4) + "; about " + significant(below, 3) + " and " +
                    significant(with_equal, 3) + " can",
                "Give one of these, or --points area.");
  }
  return threshold;
}

}  // namespace

ThresholdOptions threshold_options(const Options& resolved) {
  return {resolved.threshold, resolved.threshold_percent, resolved.coverage, resolved.erosion,
          *resolved.points};
}

double share_below(std::span<const float> density, double threshold) {
  const auto below =
      std::ranges::count_if(density, [&](float n) { return static_cast<double>(n) < threshold; });
  return static_cast<double>(below) / static_cast<double>(density.size());
}

double threshold_of(const ThresholdOptions& options, double mean, const LeafDensity& there,
                    double below) {
  const double threshold = options.threshold ? *options.threshold
                           : options.percent ? *options.percent / 100 * mean
                           : options.erosion ? threshold_for_erosion(options, below, there)
                                             : threshold_for(options, there);
  if (threshold < static_cast<double>(std::numeric_limits<float>::min())) {
    throw Error(ErrorCode::usage, "the threshold T is too small for a density",
                "Raise --threshold to 1e-30 or more.");
  }
  return threshold;
}

}  // namespace leafhull
