// SPDX-License-Identifier: Apache-2.0
#include "pipeline/measure_shape.h"

#include <algorithm>
#include <utility>

#include "pipeline/evaluate.h"
#include "pipeline/stages.h"
#include "surface/hollows.h"
#include "surface/metrics.h"

namespace leafhull {
namespace {

/// Voxels along the crown, grown by R_max, at which a dilation is counted. Source: p. 53.
constexpr int kDilationResolution = 64;

double dilation_voxel(const LeafSet& leaves, const Grid& grid) {
  return (leaves.crown.longest_side() + 2 * grid.radius_max) / kDilationResolution;
}

double dilated_share(const Metrics& metrics) {
  const auto voxels = static_cast<double>(metrics.inside_voxels + metrics.on_voxels);
  return voxels == 0 ? 0 : static_cast<double>(metrics.dilated_voxels) / voxels;
}

Metrics metrics_of(const LeafSet& leaves, const Prepared& prepared, const Field& field) {
  const Lattice& lattice = field.lattice();
  const bool area = prepared.options.points == PointSource::area;
  return measure(field, local(prepared.points->samples, lattice),
                 area ? local(positions_of(leaves.vertices), lattice) : std::vector<Vec3d>());
}

}  // namespace

double erosion_of(const Prepared& prepared, const Field& field, std::span<const Coord> dropped) {
  return share_outside(field, local(prepared.points->samples, field.lattice()), dropped);
}

double dilation_of(const Run& run, const Prepared& prepared) {
  const double voxel_size = dilation_voxel(run.leaves, prepared.grid);
  const Lattice lattice = Lattice::near(run.leaves.crown.low, voxel_size);
  DensityFunction density(run.device, *prepared.kernels, prepared.hash, lattice,
                          prepared.options.falloff);
  auto sampled = density.sample_band({prepared.threshold}, 1, false, DensityFunction::Lists::forget,
                                     [](double) {});
  const bool fill = prepared.options.hollows == Hollows::fill;
  const Field field = fill ? fill_hollows(std::move(sampled.field)) : std::move(sampled.field);
  return dilated_share(metrics_of(run.leaves, prepared, field));
}

Metrics measure(const Run& run, Stages& stages, const Prepared& prepared, const Field& field,
                std::span<const Coord> dropped) {
  run.watch.start("metrics");
  Metrics metrics = metrics_of(run.leaves, prepared, field);
  metrics.off_site_exact = static_cast<std::uint64_t>(std::ranges::count_if(
      *prepared.there, [&](float n) { return static_cast<double>(n) < prepared.threshold; }));
  const bool is_counted = prepared.grid.voxel_size == dilation_voxel(run.leaves, prepared.grid);
  metrics.dilation = is_counted ? dilated_share(metrics) : stages.dilation(prepared);
  metrics.erosion = erosion_of(prepared, field, dropped);
  return metrics;
}

}  // namespace leafhull
