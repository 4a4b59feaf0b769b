// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "leafhull/options.h"

namespace leafhull {

/// Erosion and dilation come out within this of the requested values.
inline constexpr double kSliderError = 0.01;

/// The options that T depends on besides the density; members are those of Options.
struct ThresholdOptions {
  std::optional<double> threshold, percent, coverage, erosion;
  PointSource points = PointSource::area;

  bool asks_mean() const { return !threshold && percent; }     ///< of N_iso
  bool asks_leaves() const { return !threshold && !percent; }  ///< for N on the leaves
};
ThresholdOptions threshold_options(const Options& resolved);

/// N at the places on the leaves, empty if not asked for, and which of these lie on the surface of
/// a filled crown.
struct LeafDensity {
  std::span<const float> density;
  const std::vector<bool>& in_solid;
};

/// T. `mean` is the mean of N_iso, if asked for. For an erosion, the share `below` of the leaves is
/// below T.
/// @throws Error usage: no T leaves out that share, or only one that tears a sheet; or T is too
///         small for a float.
double threshold_of(const ThresholdOptions& options, double mean, const LeafDensity& there,
                    double below);

/// The share of densities that are below T.
double share_below(std::span<const float> density, double threshold);

}  // namespace leafhull
