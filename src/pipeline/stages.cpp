// SPDX-License-Identifier: Apache-2.0
// The way from leaves to their abstract shape, stage by stage. Source: Figure 8, p. 53.
#include "pipeline/stages.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "density/control.h"
#include "leafhull/error.h"
#include "pipeline/grid.h"
#include "pipeline/memory.h"
#include "surface/brick_mesher.h"
#include "surface/metrics.h"

namespace leafhull {
namespace {

DensityKey density_key(const Report& report) {
  const Options& o = report.options;
  const bool grid = o.density == DensitySource::grid;
  return {report.radius_max_model, o.falloff, o.density, grid ? report.voxel_size : 0};
}

KernelsKey kernels_key(const Report& report) {
  const Options& o = report.options;
  return {density_key(report), *o.method, *o.flatness, o.spread, o.band_low, o.band_high};
}

Lattice lattice_of(const LeafSet& leaves, const Report& report) {
  return Lattice::near(leaves.crown.low, report.voxel_size);
}

std::vector<Vec3d> local_positions(std::span<const LeafVertex> leaves, const Lattice& lattice) {
  std::vector<Vec3d> points;
  points.reserve(leaves.size());
  for (const LeafVertex& leaf : leaves) points.push_back(lattice.local(leaf.position));
  return points;
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

}  // namespace

std::vector<float> in_crown(const LeafSet& leaves, std::vector<float> values) {
  if (leaves.stray_leaves == 0) return values;
  std::vector<float> kept;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (leaves.in_crown(leaves.vertices[i])) kept.push_back(values[i]);
  }
  return kept;
}

FieldKey field_key(const Report& report) {
  const int margin = report.options.adaptivity > 0 ? 2 : 1;  // adaptive meshing looks further
  return {kernels_key(report), report.voxel_size, margin, report.options.dense};
}

/// N of `kernels` at the leaf vertices, summed there.
std::vector<float> Stages::density_at_leaves(const Report& report,
                                             std::span<const Kernel> kernels) const {
  const Lattice lattice = leaf_lattice(leaves_, report.radius_max_model);
  DensityFunction density(device_, kernels, hash_.value, lattice, report.options.falloff);
  return density.at(local_positions(leaves_.vertices, lattice));
}

void Stages::prepare(Report& report) {
  const Options& options = report.options;
  report.device =
      device_.info().name + " (" + device_.info().platform + ", " + device_.info().variant + ")";
  report.warnings = leaves_.warnings;

  // Step 1: the grid.
  const Lattice lattice = set_grid(leaves_, report);
  const double radius_max = report.radius_max_model;

  watch_.start("hash");
  hash_.update(radius_max, [&] {
    return std::make_shared<const SpatialHash>(isotropic_kernels(leaves_.vertices, radius_max),
                                               hash_cells(leaves_, radius_max));
  });

  // Step 2: the isotropic density at the leaf vertices, summed there or, as in the paper,
  // interpolated from the lattice.
  watch_.start("isotropic density");
  isotropic_density_.update(density_key(report), [&] {
    const std::vector<Kernel> kernels = isotropic_kernels(leaves_.vertices, radius_max);
    if (options.density == DensitySource::exact) return density_at_leaves(report, kernels);
    DensityFunction density(device_, kernels, hash_.value, lattice, options.falloff);
    return density.interpolated_at(local_positions(leaves_.vertices, lattice));
  });

  // Steps 3 to 5: p1 and p2, and from them the radii.
  watch_.start("control");
  report.density = density_statistics(in_crown(leaves_, isotropic_density_.value), options);
  kernels_.update(kernels_key(report), [&] {
    return controlled_kernels(leaves_.vertices, isotropic_density_.value, report.density,
                              radius_max, options);
  });

  watch_.start("threshold");
  density_there_.update(kernels_key(report), [&] {
    const bool known =
        options.method == Method::isotropic && options.density == DensitySource::exact;
    return known ? isotropic_density_.value : density_at_leaves(report, kernels_.value);
  });
  report.threshold = threshold_of(options, report.density, in_crown(leaves_, density_there_.value));
}

FieldMemory Stages::memory(const Report& prepared, const std::vector<double>& thresholds) {
  sampled_.forget();
  return {kernels_.value, hash_.value, leaves_.bounds, prepared, thresholds, available_memory()};
}

const Field& Stages::sample(const Report& prepared, const std::vector<double>& thresholds) {
  watch_.start("field");
  const FieldKey key = field_key(prepared);
  sampled_.update({key, thresholds}, [&] {
    memory(prepared, thresholds).check();
    const auto& [kernels, voxel_size, margin, dense] = key;
    density_.emplace(device_, kernels_.value, hash_.value, lattice_of(leaves_, prepared),
                     prepared.options.falloff);
    auto [field, pairs, lists] = density_->sample_band(thresholds, margin, dense, lists_,
                                                       [&](double done) { watch_.advance(done); });
    return Sampled{std::make_shared<const Field>(std::move(field)), pairs,
                   std::make_shared<const BrickList>(std::move(lists))};
  });
  return *sampled_.value.field;
}

Polygons Stages::polygonise(const Field& field, Mesher mesher, Report& report) const {
  watch_.start("polygonise");
  const Options& options = report.options;
  Polygons polygons = mesher == Mesher::bricks && options.adaptivity == 0
                          ? mesh_bricks(field)
                          : leafhull::polygonise(field, options.adaptivity);
  const ComponentCount components = drop_small_components(polygons, *options.min_component);
  report.counts.components = components.kept;
  report.counts.dropped_components = components.dropped;
  return polygons;
}

void Stages::measure(const Field& field, Report& report) const {
  watch_.start("metrics");
  report.metrics =
      leafhull::measure(field, local_positions(leaves_.vertices, lattice_of(leaves_, report)));
  report.metrics.off_site_exact = static_cast<std::uint64_t>(
      std::count_if(density_there_.value.begin(), density_there_.value.end(),
                    [&](float n) { return static_cast<double>(n) < report.threshold; }));
  report.counts.leaves = leaves_.leaf_count;
  report.counts.leaf_vertices = leaves_.vertices.size();
  report.counts.dropped_leaves = leaves_.dropped_leaves;
  report.counts.split_components = leaves_.split_components;
  report.counts.evaluated_voxels = field.sample_count();
  report.counts.evaluated_pairs = sampled_.value.pairs;
}

void Stages::refuse_empty(const Field& field, const Report& report) const {
  const Options& options = report.options;
  const auto at_leaves = std::max_element(density_there_.value.begin(), density_there_.value.end());
  char text[200];
  std::snprintf(text, sizeof text,
                "the surface is empty: no sample reaches the threshold %.4g, the density being at "
                "most %.4g at the leaf vertices and between",
                field.threshold(), static_cast<double>(std::max(field.highest(), *at_leaves)));
  const char* lower = options.threshold           ? "Lower --threshold"
                      : options.threshold_percent ? "Lower --threshold-percent"
                                                  : "Give --threshold 50% in place of --coverage";
  throw Error(ErrorCode::empty, text,
              std::string(lower) + ", enlarge --radius-max, or take a finer --resolution.");
}

}  // namespace leafhull
