// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stage_options.h"

namespace leafhull {

FieldOptions field_options(const Options& resolved, const Grid& grid) {
  const bool area = resolved.points == PointSource::area;
  const double radius = area ? grid.radius_max : 0;
  const PointsOptions points{*resolved.points, radius * *resolved.point_spacing, radius};
  const bool on_lattice = resolved.density == DensitySource::grid;
  const DensityOptions density{{points, grid.radius_max},
                               resolved.falloff,
                               resolved.density,
                               on_lattice ? grid.voxel_size : 0};
  return {.kernels = {density, control_options(resolved)},
          .voxel_size = grid.voxel_size,
          .margin = resolved.adaptivity > 0 ? 2 : 1,  // adaptive meshing needs more
          .dense = resolved.dense};
}

}  // namespace leafhull
