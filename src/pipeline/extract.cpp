// SPDX-License-Identifier: Apache-2.0
// The way from leaves to their abstract shape, stage by stage. Source: Figure 8, p. 53.
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "density/control.h"
#include "leafhull/error.h"
#include "leafhull/shape.h"
#include "pipeline/evaluate.h"
#include "pipeline/finish_mesh.h"
#include "pipeline/grid.h"
#include "pipeline/memory.h"
#include "pipeline/stopwatch.h"
#include "surface/brick_mesher.h"
#include "surface/metrics.h"
#include "surface/polygonise.h"

namespace leafhull {
namespace {

std::vector<Vec3d> local_positions(std::span<const LeafVertex> leaves, const Lattice& lattice) {
  std::vector<Vec3d> points;
  points.reserve(leaves.size());
  for (const LeafVertex& leaf : leaves) points.push_back(lattice.local(leaf.position));
  return points;
}

/// N of `kernels` at the leaf vertices, summed there.
std::vector<float> density_at_leaves(const LeafSet& leaves, const Report& report,
                                     std::span<const Kernel> kernels,
                                     std::shared_ptr<const SpatialHash> hash, Device& device) {
  const Lattice lattice = leaf_lattice(leaves, report.radius_max_model);
  DensityFunction density(device, kernels, std::move(hash), lattice, report.options.falloff);
  return density.at(local_positions(leaves.vertices, lattice));
}

double threshold_of(const Options& options, const DensityStatistics& statistics,
                    std::span<const float> density) {
  const double threshold = options.threshold ? *options.threshold
                           : options.threshold_percent
                               ? *options.threshold_percent / 100 * statistics.mean
                               : threshold_for_coverage(density, *options.coverage);
  if (threshold < static_cast<double>(std::numeric_limits<float>::min())) {
    throw Error(ErrorCode::usage, "the threshold T is too small for a density",
                "Raise --threshold to 1e-30 or more.");
  }
  return threshold;
}

[[noreturn]] void refuse_empty(const Field& field, const Options& options,
                               std::span<const float> at_leaves) {
  const float highest =
      std::max(field.highest(), *std::max_element(at_leaves.begin(), at_leaves.end()));
  char text[200];
  std::snprintf(text, sizeof text,
                "the surface is empty: no sample reaches the threshold %.4g, the density being at "
                "most %.4g at the leaf vertices and between",
                field.threshold(), static_cast<double>(highest));
  const char* lower = options.threshold           ? "Lower --threshold"
                      : options.threshold_percent ? "Lower --threshold-percent"
                                                  : "Give --threshold 50% in place of --coverage";
  throw Error(ErrorCode::empty, text,
              std::string(lower) + ", enlarge --radius-max, or take a finer --resolution.");
}

}  // namespace

Shape extract(const LeafSet& leaves, const Options& asked, Device& device,
              const Progress& progress) {
  std::optional<tbb::global_control> limit;
  if (device.threads() > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism,
                  static_cast<std::size_t>(device.threads()));
  }
  Stopwatch watch(progress);
  Shape shape;
  Report& report = shape.report;
  const Options options = report.options = resolve(asked);

  // Step 1: the grid.
  const Lattice lattice = set_grid(leaves, report);
  const double radius_max = report.radius_max_model;

  watch.start("hash");
  shape.kernels = isotropic_kernels(leaves.vertices, radius_max);
  const auto hash =
      std::make_shared<const SpatialHash>(shape.kernels, hash_cells(leaves, radius_max));

  // Step 2: the isotropic density at the leaf vertices, summed there or, as in the paper,
  // interpolated from the lattice.
  watch.start("isotropic density");
  if (options.density == DensitySource::exact) {
    shape.isotropic_density = density_at_leaves(leaves, report, shape.kernels, hash, device);
  } else {
    DensityFunction density(device, shape.kernels, hash, lattice, options.falloff);
    shape.isotropic_density = density.interpolated_at(local_positions(leaves.vertices, lattice));
  }

  // Steps 3 to 5: p1 and p2, and from them the radii.
  watch.start("control");
  report.density = density_statistics(shape.isotropic_density, options);
  shape.kernels = controlled_kernels(leaves.vertices, shape.isotropic_density, report.density,
                                     radius_max, options);

  watch.start("threshold");
  const bool known = options.method == Method::isotropic && options.density == DensitySource::exact;
  const std::vector<float> density_there =
      known ? shape.isotropic_density
            : density_at_leaves(leaves, report, shape.kernels, hash, device);
  const double threshold = report.threshold = threshold_of(options, report.density, density_there);

  // Step 6: the density field, where the surface can be.
  watch.start("field");
  check_memory(shape.kernels, hash, leaves.bounds, report, available_memory());
  DensityFunction density(device, shape.kernels, hash, lattice, options.falloff);
  const int margin = options.adaptivity > 0 ? 2 : 1;  // adaptive meshing looks one sample further
  auto [sampled, pairs] = density.sample_band(threshold, margin, options.dense,
                                              [&](double done) { watch.advance(done); });
  const auto field = std::make_shared<const Field>(std::move(sampled));
  shape.field = field;

  // Step 7: the surface.
  watch.start("polygonise");
  Polygons polygons = options.mesher == Mesher::bricks ? mesh_bricks(*field)
                                                       : polygonise(*field, options.adaptivity);
  if (polygons.points.empty()) refuse_empty(*field, options, density_there);

  watch.start("snap");
  auto [mesh, components] = finish_mesh(std::move(polygons), density, lattice, report);
  shape.mesh = std::move(mesh);

  watch.start("metrics");
  report.metrics = measure(*field, local_positions(leaves.vertices, lattice));
  report.metrics.off_site_exact = static_cast<std::uint64_t>(
      std::count_if(density_there.begin(), density_there.end(),
                    [&](float n) { return static_cast<double>(n) < threshold; }));

  report.device =
      device.info().name + " (" + device.info().platform + ", " + device.info().variant + ")";
  report.counts = {.leaves = leaves.leaf_count,
                   .leaf_vertices = leaves.vertices.size(),
                   .dropped_leaves = leaves.dropped_leaves,
                   .split_components = leaves.split_components,
                   .evaluated_voxels = field->sample_count(),
                   .evaluated_pairs = pairs,
                   .mesh_vertices = shape.mesh.positions.size(),
                   .mesh_triangles = shape.mesh.triangles.size(),
                   .components = components.kept,
                   .dropped_components = components.dropped};
  report.warnings = leaves.warnings;
  report.seconds = watch.finish();
  return shape;
}

}  // namespace leafhull
