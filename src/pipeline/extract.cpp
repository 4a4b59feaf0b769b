// SPDX-License-Identifier: Apache-2.0
// The way from leaves to their abstract shape, stage by stage. Source: Figure 8, p. 53.
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#include "density/control.h"
#include "leafhull/error.h"
#include "leafhull/shape.h"
#include "pipeline/evaluate.h"
#include "pipeline/grid.h"
#include "pipeline/memory.h"
#include "pipeline/stopwatch.h"
#include "surface/components.h"
#include "surface/metrics.h"
#include "surface/polygonise.h"
#include "surface/volume.h"

namespace leafhull {
namespace {

constexpr int kSnapSteps = 12;

std::vector<Vec3d> local_positions(std::span<const LeafVertex> leaves, const Lattice& lattice) {
  std::vector<Vec3d> points;
  points.reserve(leaves.size());
  for (const LeafVertex& leaf : leaves) points.push_back(lattice.local(leaf.position));
  return points;
}

/// N_iso at the leaf vertices, summed there or, as in step 2 of the paper, interpolated.
std::vector<float> isotropic_density(const LeafSet& leaves, double radius_max,
                                     const Lattice& lattice, const Options& options,
                                     Device& device) {
  const std::vector<Kernel> kernels = isotropic_kernels(leaves.vertices, radius_max);
  const bool exact = options.density == DensitySource::exact;
  const Lattice where = exact ? leaf_lattice(leaves, radius_max) : lattice;
  DensityFunction density(device, kernels, where, options.falloff);
  const std::vector<Vec3d> points = local_positions(leaves.vertices, where);
  return exact ? density.at(points) : density.interpolated_at(points);
}

double threshold_of(const Options& options, const DensityStatistics& statistics,
                    std::span<const float> density) {
  const double threshold = options.threshold ? *options.threshold
                           : options.threshold_percent
                               ? *options.threshold_percent / 100 * statistics.mean
                               : threshold_for_coverage(density, *options.coverage);
  if (threshold < static_cast<double>(std::numeric_limits<float>::min())) {
    throw Error(ErrorCode::usage, "the threshold T, " + std::to_string(threshold) + ", is zero",
                "Raise --threshold.");
  }
  return threshold;
}

[[noreturn]] void refuse_empty(const Field& field, const Options& options,
                               std::span<const float> at_leaves) {
  float highest = *std::max_element(at_leaves.begin(), at_leaves.end());
  for (const float n : field.samples) highest = std::max(highest, n);
  char text[200];
  std::snprintf(text, sizeof text,
                "the surface is empty: no sample reaches the threshold %.4g, the density being at "
                "most %.4g at the leaf vertices and between",
                field.threshold, static_cast<double>(highest));
  const char* lower = options.threshold           ? "Lower --threshold"
                      : options.threshold_percent ? "Lower --threshold-percent"
                                                  : "Give --threshold 50% in place of --coverage";
  throw Error(ErrorCode::empty, text,
              std::string(lower) + ", enlarge --radius-max, or take a finer --resolution.");
}

/// Lattice positions in model units. The origin moves to the lattice's anchor only where a float at
/// the scene's coordinates would be coarser than a thousandth of a voxel.
void to_model_units(Mesh& mesh, const Lattice& lattice) {
  double largest = 0;
  for (const Vec3f p : mesh.positions) {
    const Vec3d w = lattice.world(Vec3d(p));
    largest = std::max({largest, std::fabs(w.x), std::fabs(w.y), std::fabs(w.z)});
  }
  constexpr double kFloatStep = 6e-8;
  if (largest * kFloatStep > 1e-3 * lattice.voxel_size) mesh.origin = lattice.world({0, 0, 0});
  for (Vec3f& p : mesh.positions) p = Vec3f(lattice.world(Vec3d(p)) - mesh.origin);
}

/// Where the gradient vanishes, the mean of the faces around the vertex.
void fill_missing_normals(Mesh& mesh) {
  std::vector<Vec3d> sum(mesh.positions.size());
  const auto missing = [&](std::uint32_t v) { return mesh.normals[v] == Vec3f{}; };
  for (const auto& [a, b, c] : mesh.triangles) {
    if (!missing(a) && !missing(b) && !missing(c)) continue;
    const Vec3d p(mesh.positions[a]);
    const Vec3d area = cross(Vec3d(mesh.positions[b]) - p, Vec3d(mesh.positions[c]) - p);
    for (const std::uint32_t v : {a, b, c}) sum[v] = sum[v] + area;
  }
  for (std::uint32_t v = 0; v < sum.size(); ++v) {
    if (!missing(v)) continue;
    const Vec3d mean = normalized(sum[v]);
    mesh.normals[v] =
        mean == Vec3d{} ? Vec3f(0, 1, 0) : Vec3f(mean);  // faces without area: any will do
  }
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

  // Step 2: the isotropic density at the leaf vertices.
  watch.start("isotropic density");
  shape.isotropic_density = isotropic_density(leaves, radius_max, lattice, options, device);

  // Steps 3 to 5: p1 and p2, and from them the radii.
  watch.start("control");
  report.density = density_statistics(shape.isotropic_density, options);
  shape.kernels = controlled_kernels(leaves.vertices, shape.isotropic_density, report.density,
                                     radius_max, options);

  watch.start("threshold");
  std::vector<float> density_at_leaves;
  {
    const Lattice where = leaf_lattice(leaves, radius_max);
    DensityFunction density(device, shape.kernels, where, options.falloff);
    density_at_leaves = density.at(local_positions(leaves.vertices, where));
  }
  const double threshold = report.threshold =
      threshold_of(options, report.density, density_at_leaves);

  // Step 6: the density field, where the surface can be.
  watch.start("field");
  check_memory(shape.kernels, leaves.bounds, report, available_memory());
  DensityFunction density(device, shape.kernels, lattice, options.falloff);
  const int margin = options.adaptivity > 0 ? 2 : 1;  // adaptive meshing looks one sample further
  auto [sampled, pairs] = density.sample_band({threshold, options.falloff, margin, options.dense},
                                              threshold, [&](double done) { watch.advance(done); });
  const auto field = std::make_shared<const Field>(std::move(sampled));
  shape.field = field;

  // Step 7: the surface.
  watch.start("polygonise");
  const openvdb::FloatGrid::Ptr depth = depth_grid(*field);
  Polygons polygons = polygonise(*depth, options.adaptivity);
  if (polygons.points.empty()) refuse_empty(*field, options, density_at_leaves);

  watch.start("snap");
  shape.mesh.normals = density.snap(polygons.points, threshold, options.snap ? kSnapSteps : 0);
  shape.mesh.triangles = triangulate(polygons);
  shape.mesh.positions = std::move(polygons.points);
  const ComponentCount components = drop_small_components(shape.mesh, *options.min_component);
  fill_missing_normals(shape.mesh);
  to_model_units(shape.mesh, lattice);

  watch.start("metrics");
  report.metrics = measure(*field, *depth, local_positions(leaves.vertices, lattice));
  report.metrics.off_site_exact = static_cast<std::uint64_t>(
      std::count_if(density_at_leaves.begin(), density_at_leaves.end(),
                    [&](float n) { return static_cast<double>(n) < threshold; }));

  report.device =
      device.info().name + " (" + device.info().platform + ", " + device.info().variant + ")";
  report.counts = {.leaves = leaves.leaf_count,
                   .leaf_vertices = leaves.vertices.size(),
                   .dropped_leaves = leaves.dropped_leaves,
                   .split_components = leaves.split_components,
                   .evaluated_voxels = field->samples.size(),
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
