// SPDX-License-Identifier: Apache-2.0
#include "density/control.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace leafhull {
namespace {

/// A radius is never below this share of R_max. SPEC: 1.
constexpr double kSmallestRadius = 1e-3;

/// A share of the mean. Leaf area whose N_iso deviates by less is even: what deviates is the ripple
/// of its parts, which control must not enlarge.
constexpr double kLeastSpread = 0.15;

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

DensityStatistics density_statistics(std::span<const LeafPoint> leaves,
                                     std::span<const float> isotropic_density, const Box& crown,
                                     const Options& resolved) {
  const auto weight = [&](std::size_t j) {
    if (!crown.contains(leaves[j].position)) return 0.0;
    return leaves[j].area > 0 ? leaves[j].area : 1.0;
  };
  DensityStatistics s;
  double all = 0;
  for (std::size_t j = 0; j < leaves.size(); ++j) {
    s.mean += weight(j) * static_cast<double>(isotropic_density[j]);
    all += weight(j);
  }
  s.mean /= all;
  for (std::size_t j = 0; j < leaves.size(); ++j) {
    const double above = static_cast<double>(isotropic_density[j]) - s.mean;
    s.variance += weight(j) * above * above;
  }
  return band(s.mean, s.variance / all, resolved);
}

DensityStatistics band(double mean, double variance, const Options& resolved) {
  double spread = resolved.spread == Spread::stddev ? std::sqrt(variance) : variance;
  if (resolved.points == PointSource::area) spread = std::max(spread, kLeastSpread * mean);
  return {.mean = mean,
          .variance = variance,
          .p1 = mean + resolved.band_low * spread,
          .p2 = mean + resolved.band_high * spread};
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
                                       const Options& resolved) {
  std::vector<Kernel> kernels;
  kernels.reserve(leaves.size());
  for (std::size_t j = 0; j < leaves.size(); ++j) {
    kernels.push_back(
        controlled_kernel(leaves[j], isotropic_density[j], statistics, radius_max, resolved));
  }
  return kernels;
}

Kernel controlled_kernel(const LeafPoint& leaf, float density, const DensityStatistics& statistics,
                         double radius_max, const Options& resolved) {
  if (resolved.method == Method::isotropic) {
    return kernel_at(leaf, {radius_max, radius_max, radius_max}, resolved.falloff);
  }
  const double share =
      resolved.method == Method::uncontrolled ? 1 : anisotropy(density, statistics);
  const auto radius = [&](double of_leaf) {
    const double r = radius_max + (of_leaf - radius_max) * share;
    return std::clamp(r, kSmallestRadius * radius_max, radius_max);
  };
  const double minor = leaf.radius_minor;
  return kernel_at(leaf,
                   {radius(leaf.radius_major), radius(minor), radius(*resolved.flatness * minor)},
                   resolved.falloff);
}

double clear_of_sheets(std::vector<WeightedDensity>& densities, double threshold, double coverage) {
  constexpr double kFilm = 1.2, kMost = 0.5, kBelowSheet = 0.6, kNearlyAll = 0.98;
  if (coverage >= kNearlyAll) threshold = std::min(threshold, kBelowSheet);
  std::ranges::sort(densities, {}, &WeightedDensity::density);
  std::uint64_t above = 0, film = 0;
  for (const WeightedDensity& d : densities) {
    const auto n = static_cast<double>(d.density);
    if (n >= threshold) above += d.weight;
    if (n >= threshold && n < kFilm * threshold) film += d.weight;
  }
  if (static_cast<double>(film) <= kMost * static_cast<double>(above)) return threshold;
  std::uint64_t below_middle = 0;
  for (const WeightedDensity& d : densities) {
    if (static_cast<double>(d.density) < threshold) continue;
    below_middle += d.weight;
    if (2 * below_middle >= above) return kBelowSheet * static_cast<double>(d.density);
  }
  return threshold;
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
