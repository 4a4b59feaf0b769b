// SPDX-License-Identifier: Apache-2.0
#include "leafhull/shape.h"
#include "pipeline/finish_mesh.h"
#include "pipeline/stages.h"
#include "pipeline/thread_limit.h"

namespace leafhull {

Shape extract(const LeafSet& leaves, const Options& asked, Device& device,
              const Progress& progress) {
  const ThreadLimit limit(device);
  Stopwatch watch(progress);
  Stages stages(leaves, device, watch);
  Shape shape;
  Report& report = shape.report;
  report.options = resolve(asked);

  stages.prepare(report);
  auto [found, polygons] = stages.surface(report, report.options.mesher);
  shape.field = std::make_shared<const Field>(std::move(found));
  const Field& field = *shape.field;
  if (polygons.points.empty()) stages.refuse_empty(field, report);

  watch.start("snap");
  shape.mesh = finish_mesh(std::move(polygons), stages.density(), field.lattice(), report);
  shape.mesh.colour = leaves.colour;
  report.counts.mesh_vertices = shape.mesh.positions.size();
  report.counts.mesh_triangles = shape.mesh.triangles.size();

  stages.measure(field, report);
  report.seconds = watch.finish();
  shape.kernels = stages.take_kernels();
  shape.isotropic_density = stages.take_isotropic_density();
  return shape;
}

}  // namespace leafhull
