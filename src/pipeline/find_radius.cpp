// SPDX-License-Identifier: Apache-2.0
#include "pipeline/find_radius.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace leafhull {
namespace {

constexpr double kClose = 0.004, kCloseEnough = 0.01;
constexpr int kFewCalls = 6, kMostCalls = 16;
/// The growth of the dilation when R_max grows e-fold; it is 0.2 to 0.5 on trees of all kinds.
constexpr double kSlope = 0.3, kLeastSlope = 0.1;
/// Differences in the logarithm of the radius: the longest step beyond known radii, as small radii
/// are expensive; the least that the lattice resolves, on a slope and at a peak; and the least gap
/// that may hide a peak.
constexpr double kLongestStep = 0.8, kShortest = 0.002, kShortestAtPeak = 0.1, kWideGap = 0.75;

struct Try {
  double x = 0;       ///< the logarithm of the radius
  double excess = 0;  ///< the dilation minus the wanted one
};

/// The middle of the widest gap between tries; none if no gap is wide.
std::optional<double> widest_gap(std::vector<double> places, double least, double most) {
  places.insert(places.end(), {least, most});
  std::ranges::sort(places);
  double widest = kWideGap;
  std::optional<double> middle;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double gap = places[i] - places[i - 1];
    if (gap > widest) widest = gap, middle = places[i - 1] + gap / 2;
  }
  return middle;
}

/// Where to try next, or none: between two tries of which one is too low and one too high, else
/// beyond the nearest try. `tries` ascend by x; none is close enough yet.
std::optional<double> next_nearby(const std::vector<Try>& tries, double least, double most) {
  for (std::size_t i = 1; i < tries.size(); ++i) {
    const Try &low = tries[i - 1], &high = tries[i];
    if (low.excess * high.excess > 0) continue;
    if (high.x - low.x < kShortest) return {};
    const double share = low.excess / (low.excess - high.excess);
    // Stay away from both ends, so that the interval always shrinks.
    return std::lerp(low.x, high.x, std::clamp(share, 0.05, 0.95));
  }
  const auto nearest =
      std::ranges::min_element(tries, {}, [](const Try& t) { return std::abs(t.excess); });
  const bool is_first = nearest == tries.begin(), is_last = nearest + 1 == tries.end();
  const double wanted = nearest->excess < 0 ? 1 : -1;  // the direction of the change
  if (is_first && is_last) {
    const double step = -nearest->excess / kSlope;
    return std::clamp(nearest->x + std::clamp(step, -kLongestStep, kLongestStep), least, most);
  }
  if (is_first || is_last) {
    if (is_first ? nearest->x <= least : nearest->x >= most) return {};
    const Try& other = is_first ? *(nearest + 1) : *(nearest - 1);
    const double slope = std::abs((nearest->excess - other.excess) / (nearest->x - other.x));
    const double step =
        std::min(kLongestStep, wanted * -nearest->excess / std::max(slope, kLeastSlope));
    return std::clamp(nearest->x + (is_first ? -step : step), least, most);
  }
  // At a peak or a valley, try the wider gap beside it.
  const double before = nearest->x - (nearest - 1)->x, after = (nearest + 1)->x - nearest->x;
  if (std::max(before, after) < kShortestAtPeak) return {};
  return before > after ? nearest->x - before / 2 : nearest->x + after / 2;
}

}  // namespace

std::optional<RadiusFound> find_radius(
    double wanted, double start,
    const std::function<std::optional<double>(double radius)>& dilation_at) {
  const double least = std::log(kSmallestRadiusMax), most = std::log(kLargestRadiusMax);
  std::vector<Try> tries;
  std::vector<double> places;  // all tries, including those that gave no shape
  std::optional<RadiusFound> best;
  std::optional<double> x = std::clamp(std::log(start), least, most);
  for (int call = 0; call < kMostCalls && x; ++call) {
    places.push_back(*x);
    const double radius = std::exp(*x);
    x.reset();
    if (const std::optional<double> dilation = dilation_at(radius)) {
      const double error = std::abs(*dilation - wanted);
      if (!best || error < std::abs(best->dilation - wanted)) {
        best = {radius, *dilation, error <= kCloseEnough};
      }
      if (error <= (call < kFewCalls ? kClose : kCloseEnough)) break;
      tries.push_back({places.back(), *dilation - wanted});
      std::ranges::sort(tries, {}, &Try::x);
      x = next_nearby(tries, least, most);
      if (x && std::ranges::find(places, *x) != places.end()) x.reset();
    }
    if (!x) x = widest_gap(places, least, most);
  }
  return best;
}

}  // namespace leafhull
