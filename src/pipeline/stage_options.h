// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>

#include "density/control.h"
#include "leafhull/options.h"
#include "pipeline/grid.h"

// The options that the stages of Figure 8 with kept results depend on, besides the tree. Such a
// stage gets only its struct, so an option that the struct lacks cannot change its result.

namespace leafhull {

/// The options that the leaf points depend on.
struct PointsOptions {
  PointSource source = PointSource::area;
  double spacing = 0;     ///< of parts of leaf area, model units; 0: points are vertices
  double radius_max = 0;  ///< R_max, model units, for parts of leaf area; 0: points are vertices
  auto operator<=>(const PointsOptions&) const = default;
};

/// The options that the spatial hash depends on.
struct HashOptions {
  PointsOptions points;
  double radius_max = 0;  ///< model units
  auto operator<=>(const HashOptions&) const = default;
};

/// The options that N_iso depends on.
struct DensityOptions {
  HashOptions hash;
  int falloff = 2;  ///< k
  DensitySource source = DensitySource::exact;
  double voxel_size = 0;  ///< model units, for N_iso from the lattice; 0: summed at the points
  auto operator<=>(const DensityOptions&) const = default;
};

/// The options that the kernels depend on.
struct KernelsOptions {
  DensityOptions density;
  ControlOptions control;
  auto operator<=>(const KernelsOptions&) const = default;
};

/// The options that the sampled field depends on, besides the thresholds.
struct FieldOptions {
  KernelsOptions kernels;
  double voxel_size = 0;  ///< h, model units
  int margin = 1;         ///< voxels by which blocks grow before they are decided
  bool dense = false;
  auto operator<=>(const FieldOptions&) const = default;
};

/// The options of all stages up to the field, nested.
FieldOptions field_options(const Options& resolved, const Grid& grid);

}  // namespace leafhull
