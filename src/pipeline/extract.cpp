// SPDX-License-Identifier: Apache-2.0
// Leaves to their abstract shape, stage by stage. Source: Figure 8, p. 53.
#include "leafhull/shape.h"
#include "pipeline/describe.h"
#include "pipeline/finish_mesh.h"
#include "pipeline/measure_shape.h"
#include "pipeline/sliders.h"

namespace leafhull {

Shape extract(const LeafSet& leaves, const Options& asked, Device& device, const Progress& progress,
              Detail detail) {
  const ThreadLimit limit(device.threads());
  Stopwatch watch(progress);
  const Run run{leaves, device, watch, detail};
  Stages stages(run);
  Sliders sliders(run, stages, resolve(asked));

  Prepared prepared = sliders.prepare();
  auto [sampled, pieces] = sliders.surface(prepared, DensityFunction::Lists::keep_few);
  if (pieces.polygons.points.empty()) {
    refuse_empty(prepared, *stages.there(prepared), sampled.field);
  }

  Shape shape;
  shape.report = describe(run, prepared);
  describe_pieces(pieces, shape.report);
  watch.start("snap");
  shape.mesh = finish_mesh(std::move(pieces.polygons), *sampled.density, sampled.field.lattice(),
                           prepared.threshold, prepared.options.snap);
  shape.mesh.colour = leaves.colour;
  sampled.density.reset();

  if (detail == Detail::report) {
    shape.report.metrics = measure(run, stages, prepared, sampled.field, pieces.dropped_cells);
  }
  describe_mesh(shape.mesh, sampled, shape.report);
  shape.report.seconds = watch.finish();
  stages.forget();
  prepared.there.reset();  // may be N_iso itself
  shape.kernels = taken(std::move(prepared.kernels));
  if (prepared.isotropic_density) {
    shape.isotropic_density = taken(std::move(prepared.isotropic_density));
  }
  shape.field = std::make_shared<const Field>(std::move(sampled.field));
  return shape;
}

}  // namespace leafhull
