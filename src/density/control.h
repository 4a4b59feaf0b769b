// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "leafhull/leaves.h"
#include "leafhull/options.h"
#include "leafhull/shape.h"

namespace leafhull {

/// An end of the band between isotropic kernels and those with their leaf's shape: a number of
/// spreads above the mean density, or the density that a percentage of the leaves does not exceed.
struct BandEnd {
  std::optional<double> deviations, percent;
  auto operator<=>(const BandEnd&) const = default;
};

/// How kernels are controlled; the members are those of Options.
struct ControlOptions {
  Method method = Method::controlled;
  double flatness = 1;  ///< lambda_R
  Spread spread = Spread::stddev;
  BandEnd low{}, high{};  ///< p1 and p2
  PointSource points = PointSource::area;
  int falloff = 2;  ///< k
  auto operator<=>(const ControlOptions&) const = default;
};
ControlOptions control_options(const Options& resolved);

/// Mean and variance of N_iso over the leaf points in `crown`, by their area, and the densities p1
/// and p2 between which kernels go from isotropic to the shape of their leaf. Source: Eqs. (9),
/// (10); the paper prints the variance for the spread (SPEC: 3, open point).
DensityStatistics density_statistics(std::span<const LeafPoint> leaves,
                                     std::span<const float> isotropic_density, const Box& crown,
                                     const ControlOptions& options);

/// The density that a share of the leaf area, from 0 to 1, does not exceed.
using DensityQuantile = std::function<double(double share)>;

/// Density statistics from a mean, a variance and quantiles.
/// @throws Error usage: p1 above p2, with Method::controlled.
DensityStatistics band(double mean, double variance, const DensityQuantile& quantile,
                       const ControlOptions& options);

/// The kernels that measure N_iso: radius `radius_max` (model units) in every direction. A kernel
/// of leaf area a has the weight (k + 1) a / (pi R_u R_v), so that N counts layers of leaf; one at
/// a vertex has 1. SPEC: 2.
std::vector<Kernel> isotropic_kernels(std::span<const LeafPoint> leaves, double radius_max,
                                      int falloff);

/// The kernels of the chosen method. Their radii are R_max, the leaf's own, or between the two by
/// the density at each leaf point; none exceeds R_max. `isotropic_density` has one value per leaf
/// point; only Method::controlled reads it. `radius_max` is in model units. Source: Eqs. (7), (8).
std::vector<Kernel> controlled_kernels(std::span<const LeafPoint> leaves,
                                       std::span<const float> isotropic_density,
                                       const DensityStatistics& statistics, double radius_max,
                                       const ControlOptions& options);

/// The controlled kernel of one leaf point, where N_iso = `density`.
Kernel controlled_kernel(const LeafPoint& leaf, float density, const DensityStatistics& statistics,
                         double radius_max, const ControlOptions& options);

/// The share of anisotropy at density n, 0 at p1 and below to 1 at p2 and above. Source: Eq. (8).
double anisotropy(double n, const DensityStatistics& statistics);

/// A density and its weight, a whole number so that sums do not depend on their order.
struct WeightedDensity {
  float density;
  std::uint64_t weight = 1;
  bool in_solid = false;  ///< on the surface of a filled crown
};

/// N is 1 on a lone sheet of leaf, so at a T close to that the surface would be a film with holes.
/// If most of the area above T exceeds it by less than a fifth, as on closed crowns, returns 0.6 of
/// the median density of the area above T, which tears no sheet. Filled crowns do not tear and do
/// not count. Sorts `densities`.
std::optional<double> below_film(std::vector<WeightedDensity>& densities, double threshold);

/// T for a coverage of leaf area whose quantile is `threshold`, lowered so that sheets of leaf are
/// not torn: T stays below a film, and is at most 0.6 for a coverage of 0.98 or more. A filled
/// crown has about one density over its surface, so its quantiles say little. If most leaves lie on
/// filled crowns, T is at most 0.27 of their median density for a coverage of 0.95, 0.24 for 0.98,
/// and 0.12 for 0.99. Sorts `densities`.
double clear_of_sheets(std::vector<WeightedDensity>& densities, double threshold, double coverage);

/// The T that the fraction `coverage` of the densities reaches. It lies halfway between two
/// densities adjacent in rank, so that rounding moves no leaf vertex across it.
double threshold_for_coverage(std::span<const float> density, double coverage);

}  // namespace leafhull
