// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "leafhull/options.h"

namespace leafhull {

/// Both sliders, erosion and dilation, keep what was asked for within this.
inline constexpr double kSliderError = 0.01;

/// What T depends on beside the density: as in Options.
struct ThresholdOptions {
  std::optional<double> threshold, percent, coverage, erosion;
  PointSource points = PointSource::area;
};
ThresholdOptions threshold_options(const Options& resolved);

/// N at the places on the leaves, and which of them are on the surface of a crown that is filled.
struct LeafDensity {
  std::span<const float> density;
  const std::vector<bool>& in_solid;
};

/// T. `mean` is that of N_iso; for an erosion, T leaves the share `below` of the leaves below it.
/// @throws Error usage: no T leaves out that share, or only one that tears a sheet; or T is too
///         small for a float.
double threshold_of(const ThresholdOptions& options, double mean, const LeafDensity& there,
                    double below);

/// The share of densities that are below T.
double share_below(std::span<const float> density, double threshold);

}  // namespace leafhull
