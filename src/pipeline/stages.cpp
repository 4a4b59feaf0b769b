// SPDX-License-Identifier: Apache-2.0
// Steps 1 to 5 of Figure 8, p. 53. Each step is a function of its arguments alone.
#include "pipeline/stages.h"

#include <utility>

#include "density/control.h"
#include "pipeline/evaluate.h"
#include "pipeline/measure_shape.h"
#include "pipeline/threshold.h"

namespace leafhull {
namespace {

LeafPoints points_of(const LeafSet& leaves, const PointsOptions& options) {
  return options.source == PointSource::area
             ? area_points(leaves, options.spacing, options.radius_max)
             : vertex_points(leaves);
}

SpatialHash hash_of(const LeafSet& leaves, const LeafPoints& points, const HashOptions& options) {
  return {positions_of(points.points), hash_cells(leaves, options.radius_max)};
}

/// N of `kernels`, summed at `places`.
std::vector<float> density_at(const Run& run, std::span<const Vec3d> places,
                              std::span<const Kernel> kernels,
                              std::shared_ptr<const SpatialHash> hash,
                              const DensityOptions& options) {
  const Lattice lattice = leaf_lattice(run.leaves, options.hash.radius_max);
  DensityFunction density(run.device, kernels, std::move(hash), lattice, options.falloff);
  return density.at(local(places, lattice));
}

/// Step 2: the isotropic density at the leaf points, summed there or, as in the paper, interpolated
/// from the lattice.
std::vector<float> isotropic_density_of(const Run& run, const LeafPoints& points,
                                        std::shared_ptr<const SpatialHash> hash,
                                        const DensityOptions& options) {
  const std::vector<Kernel> kernels =
      isotropic_kernels(points.points, options.hash.radius_max, options.falloff);
  const std::vector<Vec3d> places = positions_of(points.points);
  if (options.source == DensitySource::exact) {
    return density_at(run, places, kernels, std::move(hash), options);
  }
  const Lattice lattice = Lattice::near(run.leaves.crown.low, options.voxel_size);
  DensityFunction density(run.device, kernels, std::move(hash), lattice, options.falloff);
  return density.interpolated_at(local(places, lattice));
}

/// Whether N at the places on the leaves equals N_iso: same kernels, summed at the same places.
bool is_isotropic_density(const LeafSet& leaves, const KernelsOptions& options) {
  return options.control.method == Method::isotropic &&
         options.density.source == DensitySource::exact &&
         options.density.hash.points.source == PointSource::vertices && leaves.stray_leaves == 0;
}

}  // namespace

Prepared Stages::prepare(const Options& resolved, double below) {
  const Run& run = run_;
  const LeafSet& leaves = run.leaves;
  Stopwatch& watch = run.watch;
  Prepared p{.options = resolved, .grid = grid_of(leaves, resolved)};
  p.field = field_options(resolved, p.grid);
  const KernelsOptions& of_kernels = p.field.kernels;
  const DensityOptions& of_density = of_kernels.density;
  const double radius_max = of_density.hash.radius_max;

  watch.start("points");
  p.points = points_.get(of_density.hash.points,
                         [&] { return points_of(leaves, of_density.hash.points); });

  watch.start("hash");
  p.hash = hash_.get(of_density.hash, [&] { return hash_of(leaves, *p.points, of_density.hash); });

  const bool reports = run.detail == Detail::report;
  const ThresholdOptions of_threshold = threshold_options(resolved);
  std::span<const float> isotropic_density;
  if (reports || of_kernels.control.method == Method::controlled || of_threshold.asks_mean()) {
    watch.start("isotropic density");
    p.isotropic_density = isotropic_density_.get(
        of_density, [&] { return isotropic_density_of(run, *p.points, p.hash, of_density); });
    isotropic_density = *p.isotropic_density;
  }

  // Steps 3 to 5: p1 and p2, and from them the radii.
  watch.start("control");
  if (p.isotropic_density) {
    p.statistics =
        density_statistics(p.points->points, isotropic_density, leaves.crown, of_kernels.control);
  }
  p.kernels = kernels_.get(of_kernels, [&] {
    return controlled_kernels(p.points->points, isotropic_density, p.statistics, radius_max,
                              of_kernels.control);
  });

  watch.start("threshold");
  std::span<const float> on_leaves;
  if (reports || of_threshold.asks_leaves()) {
    p.there = there(p);
    on_leaves = *p.there;
  }
  p.threshold =
      threshold_of(of_threshold, p.statistics.mean, {on_leaves, p.points->in_solid}, below);
  return p;
}

std::shared_ptr<std::vector<float>> Stages::there(const Prepared& prepared) {
  const Run& run = run_;
  const KernelsOptions& key = prepared.field.kernels;
  if (prepared.isotropic_density && is_isotropic_density(run.leaves, key)) {
    return prepared.isotropic_density;
  }
  return there_.get(key, [&] {
    return density_at(run, prepared.points->samples, *prepared.kernels, prepared.hash, key.density);
  });
}

double Stages::dilation(const Prepared& prepared) {
  const Run& run = run_;
  run.watch.start("dilation");
  const DilationOptions key{prepared.field.kernels, prepared.threshold, *prepared.options.hollows};
  return *dilation_.get(key, [&] { return dilation_of(run, prepared); });
}

}  // namespace leafhull
