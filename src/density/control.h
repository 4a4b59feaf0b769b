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

/// An end of the band between isotropic kernels and those of their leaves: so many spreads above
/// the mean density, or the density that a percentage of the leaves does not exceed.
struct BandEnd {
  std::optional<double> deviations, percent;
  auto operator<=>(const BandEnd&) const = default;
};

/// How kernels are controlled. As in Options.
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

/// The same from a mean, a variance and quantiles.
/// @throws Error usage: p1 above p2.
DensityStatistics band(double mean, double variance, const DensityQuantile& quantile,
                       const ControlOptions& options);

/// The kernels that measure N_iso: radius `radius_max` (model units) in every direction. A kernel
/// of leaf area a has the weight (k + 1) a / (pi R_u R_v), so that N counts layers of leaf; one at
/// a vertex has 1. SPEC: 2.
std::vector<Kernel> isotropic_kernels(std::span<const LeafPoint> leaves, double radius_max,
                                      int falloff);

/// The kernels of the chosen method: isotropic, the leaf's own radii, or between the two by the
/// density at each leaf point; none above R_max. `isotropic_density` has one value per leaf point;
/// `radius_max` is in model units. Source: Eqs. (7), (8).
std::vector<Kernel> controlled_kernels(std::span<const LeafPoint> leaves,
                                       std::span<const float> isotropic_density,
                                       const DensityStatistics& statistics, double radius_max,
                                       const ControlOptions& options);

/// One of them, for a leaf point with N_iso = `density` there.
Kernel controlled_kernel(const LeafPoint& leaf, float density, const DensityStatistics& statistics,
                         double radius_max, const ControlOptions& options);

/// The share of anisotropy at density n, 0 at p1 and below to 1 at p2 and above. Source: Eq. (8).
double anisotropy(double n, const DensityStatistics& statistics);

/// A density, and how much it counts: whole numbers, whose sums do not depend on their order.
struct WeightedDensity {
  float density;
  std::uint64_t weight = 1;
  bool in_solid = false;  ///< on the surface of a crown that is filled
};

/// N is 1 on a sheet of leaf that lies alone, and at a T next to that the surface would be a film
/// with holes. So where most of the area above T is above it by less than a fifth, as on closed
/// crowns: 0.6 of what that area has in the middle, which does not tear it. A crown that is filled
/// is not torn. `densities` come back sorted.
std::optional<double> below_film(std::vector<WeightedDensity>& densities, double threshold);

/// T for a coverage of leaf area, `threshold` being its quantile, such that sheets of leaf are not
/// torn: below a film, and where nearly all leaves are asked for, 0.98 or more, at most 0.6. The
/// surface of a filled crown has about one density, so that its quantiles are about the same; where
/// most leaves are on such, a coverage of 0.95 takes in all that has 0.27 of the density that half
/// of them have, one of 0.98 what has 0.24, one of 0.99 what has 0.12. `densities` come back
/// sorted.
double clear_of_sheets(std::vector<WeightedDensity>& densities, double threshold, double coverage);

/// T such that the fraction `coverage` of the densities is at least T: halfway between the two
/// neighbours in rank, so that rounding does not move a leaf vertex across.
double threshold_for_coverage(std::span<const float> density, double coverage);

}  // namespace leafhull
