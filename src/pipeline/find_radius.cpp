// SPDX-License-Identifier: Apache-2.0
#include "pipeline/find_radius.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace leafhull {
namespace {

constexpr double kClose = 0.004, kCloseEnough = 0.01;
constexpr int kMostCalls = 12;
/// How much the dilation grows as R_max grows e-fold: on trees of all kinds 0.2 to 0.5, more where
/// leaves are few.
constexpr double kSlope = 0.3, kLeastSlope = 0.1, kMostSlope = 1;

struct Try {
  double x = 0;  ///< the logarithm of the radius
  double dilation = 0;
};

}  // namespace

RadiusFound find_radius(double wanted, double start,
                        const std::function<double(double radius)>& dilation_at) {
  const double least = std::log(kSmallestRadiusMax), most = std::log(kLargestRadiusMax);
  std::optional<Try> below, above, last;
  RadiusFound best;
  double x = std::clamp(std::log(start), least, most), slope = kSlope;
  for (int call = 0; call < kMostCalls; ++call) {
    const double radius = std::exp(x);
    const Try here{x, dilation_at(radius)};
    const double missing = wanted - here.dilation;
    if (call == 0 || std::abs(missing) < std::abs(wanted - best.dilation)) {
      best = {radius, here.dilation, std::abs(missing) <= kCloseEnough};
    }
    if (std::abs(missing) <= kClose) break;
    if (missing > 0 ? x >= most : x <= least) break;  // the end of what can be had
    (missing > 0 ? below : above) = here;
    if (below && above) {
      if (above->x - below->x < 1e-3) break;
      const double share = (wanted - below->dilation) / (above->dilation - below->dilation);
      // Away from the ends, so that the interval always shrinks.
      x = below->x + (above->x - below->x) * std::clamp(share, 0.05, 0.95);
    } else {
      if (last) {
        slope = std::clamp((here.dilation - last->dilation) / (here.x - last->x), kLeastSlope,
                           kMostSlope);
      }
      x = std::clamp(x + missing / slope, least, most);
    }
    last = here;
  }
  return best;
}

}  // namespace leafhull
