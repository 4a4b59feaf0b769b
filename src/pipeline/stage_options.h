// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>

#include "density/control.h"
#include "leafhull/options.h"
#include "pipeline/grid.h"

// What the stages of Figure 8 whose results are kept depend on beside the tree. Such a stage is
// given its struct and nothing else of the options, so what that does not name cannot change its
// result.

namespace leafhull {

/// What the leaf points depend on.
struct PointsOptions {
  PointSource source = PointSource::area;
  double spacing = 0;     ///< of parts of area, model units; 0: vertices
  double radius_max = 0;  ///< R_max, model units, of parts of area; 0: vertices
  auto operator<=>(const PointsOptions&) const = default;
};

/// What the spatial hash depends on.
struct HashOptions {
  PointsOptions points;
  double radius_max = 0;  ///< model units
  auto operator<=>(const HashOptions&) const = default;
};

/// What N_iso depends on.
struct DensityOptions {
  HashOptions hash;
  int falloff = 2;  ///< k
  DensitySource source = DensitySource::exact;
  double voxel_size = 0;  ///< model units, of a density from the lattice; 0: summed at the points
  auto operator<=>(const DensityOptions&) const = default;
};

/// What the kernels depend on.
struct KernelsOptions {
  DensityOptions density;
  ControlOptions control;
  auto operator<=>(const KernelsOptions&) const = default;
};

/// What the sampled field depends on, beside the thresholds.
struct FieldOptions {
  KernelsOptions kernels;
  double voxel_size = 0;  ///< h, model units
  int margin = 1;         ///< voxels by which blocks grow before they are decided
  bool dense = false;
  auto operator<=>(const FieldOptions&) const = default;
};

/// The options of the stages up to the field, one in the other.
FieldOptions field_options(const Options& resolved, const Grid& grid);

}  // namespace leafhull
