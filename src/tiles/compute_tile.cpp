// SPDX-License-Identifier: Apache-2.0
#include "tiles/compute_tile.h"

#include <algorithm>
#include <utility>

#include "density/control.h"
#include "pipeline/evaluate.h"
#include "surface/brick_mesher.h"
#include "tiles/finish_tile.h"
#include "tiles/gather.h"
#include "tiles/tile_plan.h"

namespace leafhull {
namespace {

/// A tile's surroundings.
class Place {
 public:
  Place(const ForestLevel& level, const TileTask& task, Device& device)
      : level_(level),
        task_(task),
        device_(device),
        lattice_(tile_lattice(task.id, level.voxel_size, task.edge)) {}

  const Lattice& lattice() const { return lattice_; }
  SampleBox own() const { return {{0, 0, 0}, {task_.edge, task_.edge, task_.edge}}; }

  /// A box of samples, in scene units.
  Box box_of(const SampleBox& samples) const {
    const auto corner = [&](Coord c) { return lattice_.world(to_vec3d(c)); };
    return {corner(samples.low), corner(samples.high)};
  }

  std::vector<KernelRun> runs_near(const Box& box) const {
    return leafhull::runs_near(level_, task_.trees, box);
  }

  DensityFunction density(std::span<const KernelRun> runs, const KernelOf& kernel) const {
    return {device_, placed_kernels(level_, runs, lattice_, kernel), level_.options.falloff};
  }

  /// The density N of the kernels of `runs`.
  DensityFunction density(std::span<const KernelRun> runs) const {
    if (level_.scope == ControlScope::model) {
      return density(runs, [](const ForestModel& model, std::size_t j, std::size_t) {
        return model.kernels[j];
      });
    }
    const std::vector<float> isotropic = isotropic_at(local_centres(runs), runs);
    const ControlOptions control = control_options(level_.options);
    return density(runs, [&](const ForestModel& model, std::size_t j, std::size_t at) {
      Kernel kernel = controlled_kernel(model.leaves[j], isotropic[at], *level_.scene_statistics,
                                        model.radius_max, control);
      kernel.weight = model.kernels[j].weight;
      return kernel;
    });
  }

  /// N_iso at the centres of `runs`.
  std::vector<float> isotropic_at(std::span<const Vec3d> points,
                                  std::span<const KernelRun> runs) const {
    if (points.empty()) return {};
    Box around;
    for (const Vec3d& p : centres_of(level_, runs)) around.include(p);
    const std::vector<KernelRun> wide = runs_near(around);
    return density(wide,
                   [this](const ForestModel& model, std::size_t j, std::size_t) {
                     const double r = model.radius_max;
                     return isotropic_kernels(std::span(model.leaves).subspan(j, 1), r,
                                              level_.options.falloff)
                         .front();
                   })
        .at(points);
  }

  std::vector<Vec3d> local_centres(std::span<const KernelRun> runs) const {
    std::vector<Vec3d> points = centres_of(level_, runs);
    for (Vec3d& p : points) p = lattice_.local(p);
    return points;
  }

  struct Centres {
    std::vector<Vec3d> points;
    std::vector<std::uint64_t> weights;
    std::vector<bool> in_solid;  ///< as in LeafPoints
  };

  /// The leaf points in the tile.
  Centres own_centres(std::span<const KernelRun> runs) const {
    const std::vector<Vec3d> centres = local_centres(runs);
    return own(centres, weights_of(level_, runs), std::vector<bool>(centres.size()));
  }

  /// The places on leaves in the tile.
  Centres own_samples() const {
    const Box box = box_of(own());
    const Vec3d rounding = (box.high - box.low) * 1e-3;
    PlacedSamples samples =
        samples_in(level_, task_.trees, {box.low - rounding, box.high + rounding});
    for (Vec3d& p : samples.points) p = lattice_.local(p);
    return own(samples.points, samples.weights, samples.in_solid);
  }

 private:
  Centres own(std::span<const Vec3d> points, std::span<const std::uint64_t> weights,
              const std::vector<bool>& in_solid) const {
    Centres centres;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!own().meets({cell_of(points[i]), 1})) continue;
      centres.points.push_back(points[i]);
      centres.weights.push_back(weights[i]);
      centres.in_solid.push_back(in_solid[i]);
    }
    return centres;
  }

  const ForestLevel& level_;
  const TileTask& task_;
  Device& device_;
  Lattice lattice_;
};

std::vector<WeightedDensity> weighted(std::span<const float> densities,
                                      std::span<const std::uint64_t> weights,
                                      const std::vector<bool>& in_solid) {
  std::vector<WeightedDensity> all;
  for (std::size_t i = 0; i < densities.size(); ++i) {
    all.push_back({densities[i], weights[i], in_solid[i]});
  }
  return all;
}

}  // namespace

TileSurface compute_tile(const ForestLevel& level, const TileTask& task, Device& device) {
  const Place place(level, task, device);
  const SampleBox around = samples_around(task.edge);
  const std::vector<KernelRun> runs = place.runs_near(place.box_of(around));
  TileSurface surface;
  surface.gathered = count(runs);
  surface.leaf_vertices = place.own_centres(runs).points.size();
  if (runs.empty()) return surface;

  DensityFunction density = place.density(runs);
  OwnedPolygons part;
  {
    const auto sampled = density.sample_band(level.threshold, around);
    surface.evaluated_voxels = sampled.field.sample_count();
    part = mesh_bricks(sampled.field, place.own());
  }
  finish_tile(std::move(part), density, level, place.lattice(), place.own(), surface);
  return surface;
}

std::vector<WeightedDensity> isotropic_density_in(const ForestLevel& level, const TileTask& task,
                                                  Device& device) {
  const Place place(level, task, device);
  const std::vector<KernelRun> runs = place.runs_near(place.box_of(place.own()));
  const auto [points, weights, in_solid] = place.own_centres(runs);
  return weighted(place.isotropic_at(points, runs), weights, in_solid);
}

std::vector<WeightedDensity> density_in(const ForestLevel& level, const TileTask& task,
                                        Device& device) {
  const Place place(level, task, device);
  const Place::Centres samples = place.own_samples();
  if (samples.points.empty()) return {};
  const std::vector<KernelRun> runs = place.runs_near(place.box_of(place.own()));
  return weighted(place.density(runs).at(samples.points), samples.weights, samples.in_solid);
}

}  // namespace leafhull
