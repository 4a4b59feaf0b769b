// SPDX-License-Identifier: Apache-2.0
#include "density/control.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "leafhull/error.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

/// A radius is never below this share of R_max. SPEC: 1.
constexpr double kSmallestRadius = 1e-3;

/// A share of the mean of N_iso. A smaller spread counts as even: it is only the ripple between the
/// parts of leaves, which control must not amplify.
constexpr double kLeastSpread = 0.15;

std::string text_of(const BandEnd& end) {
  return end.percent ? significant(*end.percent, 6) + "%" : significant(*end.deviations, 6);
}

[[noreturn]] void refuse_upside_down(const DensityStatistics& s, const ControlOptions& options) {
  throw Error(ErrorCode::usage,
              "the band is upside down: --band-low " + text_of(options.low) + " is a density of " +
                  significant(s.p1, 4) + " on this tree, --band-high " + text_of(options.high) +
                  " one of " + significant(s.p2, 4),
              "Give both ends in percent, or both as deviations.");
}

/// The highest threshold that keeps a sheet whole, as a share of the sheet's density.
constexpr double kBelowSheet = 0.6;

Kernel kernel_at(const LeafPoint& leaf, Vec3d radii, int falloff) {
  // A kernel's integral over its own plane is pi R_u R_v / (k + 1).
  const double weight =
      leaf.area > 0 ? (falloff + 1) * leaf.area / (std::numbers::pi * radii.x * radii.y) : 1;
  return {leaf.position,
          leaf.normal,
          leaf.major,
          static_cast<float>(radii.x),
          static_cast<float>(radii.y),
          static_cast<float>(radii.z),
          static_cast<float>(weight)};
}

}  // namespace

ControlOptions control_options(const Options& resolved) {
  return {.method = *resolved.method,
          .flatness = *resolved.flatness,
          .spread = resolved.spread,
          .low = {resolved.band_low, resolved.band_low_percent},
          .high = {resolved.band_high, resolved.band_high_percent},
          .points = *resolved.points,
          .falloff = resolved.falloff};
}

DensityStatistics density_statistics(std::span<const LeafPoint> leaves,
                                     std::span<const float> isotropic_density, const Box& crown,
                                     const ControlOptions& options) {
  const auto weight = [&](std::size_t j) {
    if (!crown.contains(leaves[j].position)) return 0.0;
    return leaves[j].area > 0 ? leaves[j].area : 1.0;
  };
  double mean = 0, variance = 0, all = 0;
  for (std::size_t j = 0; j < leaves.size(); ++j) {
    mean += weight(j) * static_cast<double>(isotropic_density[j]);
    all += weight(j);
  }
  mean /= all;
  for (std::size_t j = 0; j < leaves.size(); ++j) {
    const double above = static_cast<double>(isotropic_density[j]) - mean;
    variance += weight(j) * above * above;
  }
  std::vector<std::size_t> ranked;
  const auto quantile = [&](double share) {
    if (ranked.empty()) {
      ranked.resize(leaves.size());
      std::iota(ranked.begin(), ranked.end(), std::size_t{0});
      std::ranges::stable_sort(ranked, {}, [&](std::size_t j) { return isotropic_density[j]; });
      std::erase_if(ranked, [&](std::size_t j) { return weight(j) == 0; });
    }
    double up_to = 0;
    for (const std::size_t j : ranked) {
      up_to += weight(j);
      if (up_to >= share * all) return static_cast<double>(isotropic_density[j]);
    }
    return static_cast<double>(isotropic_density[ranked.back()]);
  };
  return band(mean, variance / all, quantile, options);
}

DensityStatistics band(double mean, double variance, const DensityQuantile& quantile,
                       const ControlOptions& options) {
  const bool area = options.points == PointSource::area;
  double spread = options.spread == Spread::stddev ? std::sqrt(variance) : variance;
  if (area) spread = std::max(spread, kLeastSpread * mean);
  const auto density_at = [&](const BandEnd& end) {
    return end.percent ? quantile(*end.percent / 100) : mean + *end.deviations * spread;
  };
  DensityStatistics s{.mean = mean,
                      .variance = variance,
                      .p1 = density_at(options.low),
                      .p2 = density_at(options.high)};
  if (s.p1 > s.p2 && options.method == Method::controlled) refuse_upside_down(s, options);
  if (area && options.low.percent && options.high.percent) {
    const double missing = std::max(0.0, 2 * kLeastSpread * mean - (s.p2 - s.p1));
    s.p1 -= missing / 2;
    s.p2 += missing / 2;
  }
  return s;
}

std::vector<Kernel> isotropic_kernels(std::span<const LeafPoint> leaves, double radius_max,
                                      int falloff) {
  std::vector<Kernel> kernels;
  kernels.reserve(leaves.size());
  for (const LeafPoint& leaf : leaves) {
    kernels.push_back(kernel_at(leaf, {radius_max, radius_max, radius_max}, falloff));
  }
  return kernels;
}

double anisotropy(double n, const DensityStatistics& statistics) {
  if (n <= statistics.p1) return 0;
  if (n >= statistics.p2) return 1;
  return (n - statistics.p1) / (statistics.p2 - statistics.p1);
}

std::vector<Kernel> controlled_kernels(std::span<const LeafPoint> leaves,
                                       std::span<const float> isotropic_density,
                                       const DensityStatistics& statistics, double radius_max,
                                       const ControlOptions& options) {
  std::vector<Kernel> kernels;
  kernels.reserve(leaves.size());
  for (std::size_t j = 0; j < leaves.size(); ++j) {
    const float density = options.method == Method::controlled ? isotropic_density[j] : 0;
    kernels.push_back(controlled_kernel(leaves[j], density, statistics, radius_max, options));
  }
  return kernels;
}

Kernel controlled_kernel(const LeafPoint& leaf, float density, const DensityStatistics& statistics,
                         double radius_max, const ControlOptions& options) {
  if (options.method == Method::isotropic) {
    return kernel_at(leaf, {radius_max, radius_max, radius_max}, options.falloff);
  }
  const double share = options.method == Method::uncontrolled ? 1 : anisotropy(density, statistics);
  const auto radius = [&](double of_leaf) {
    const double r = radius_max + (of_leaf - radius_max) * share;
    return std::clamp(r, kSmallestRadius * radius_max, radius_max);
  };
  const double minor = leaf.radius_minor;
  return kernel_at(leaf,
                   {radius(leaf.radius_major), radius(minor), radius(options.flatness * minor)},
                   options.falloff);
}

namespace {

/// The T that encloses filled crowns for a coverage, if most leaves lie on them; none if `coverage`
/// is below 0.95. `densities` are sorted.
std::optional<double> around_solids(std::span<const WeightedDensity> densities, double coverage) {
  std::uint64_t all = 0, in_solids = 0, up_to = 0;
  for (const WeightedDensity& d : densities) {
    all += d.weight;
    if (d.in_solid) in_solids += d.weight;
  }
  if (coverage < 0.95 || 2 * in_solids < all) return {};
  const double share = coverage < 0.98   ? std::lerp(0.27, 0.24, (coverage - 0.95) / 0.03)
                       : coverage < 0.99 ? std::lerp(0.24, 0.12, (coverage - 0.98) / 0.01)
                                         : 0.12;
  for (const WeightedDensity& d : densities) {
    if (!d.in_solid) continue;
    up_to += d.weight;
    if (2 * up_to >= in_solids) return share * static_cast<double>(d.density);
  }
  return {};
}

}  // namespace

std::optional<double> below_film(std::vector<WeightedDensity>& densities, double threshold) {
  constexpr double kFilm = 1.2, kMost = 0.5;
  std::ranges::sort(densities, {}, &WeightedDensity::density);
  std::uint64_t above = 0, film = 0;
  for (const WeightedDensity& d : densities) {
    const auto n = static_cast<double>(d.density);
    if (n >= threshold) above += d.weight;
    if (n >= threshold && n < kFilm * threshold && !d.in_solid) film += d.weight;
  }
  if (static_cast<double>(film) <= kMost * static_cast<double>(above)) return {};
  std::uint64_t below_middle = 0;
  for (const WeightedDensity& d : densities) {
    if (static_cast<double>(d.density) < threshold) continue;
    below_middle += d.weight;
    if (2 * below_middle >= above) return kBelowSheet * static_cast<double>(d.density);
  }
  return {};
}

double clear_of_sheets(std::vector<WeightedDensity>& densities, double threshold, double coverage) {
  constexpr double kNearlyAll = 0.98;
  if (coverage >= kNearlyAll) threshold = std::min(threshold, kBelowSheet);
  std::ranges::sort(densities, {}, &WeightedDensity::density);
  if (const auto around = around_solids(densities, coverage)) {
    threshold = std::min(threshold, *around);
  }
  return below_film(densities, threshold).value_or(threshold);
}

double threshold_for_coverage(std::span<const float> density, double coverage) {
  std::vector<float> ranked(density.begin(), density.end());
  const std::size_t count = ranked.size();
  const auto below =
      std::min(count - 1,
               static_cast<std::size_t>(std::llround((1 - coverage) * static_cast<double>(count))));
  const auto at = ranked.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(ranked.begin(), at, ranked.end());
  if (below == 0) return *at;
  const float lower = *std::max_element(ranked.begin(), at);
  return 0.5 * (static_cast<double>(lower) + static_cast<double>(*at));
}

}  // namespace leafhull
