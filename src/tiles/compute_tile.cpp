// SPDX-License-Identifier: Apache-2.0
#include "tiles/compute_tile.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "density/control.h"
#include "pipeline/evaluate.h"
#include "surface/brick_mesher.h"
#include "surface/mesh_components.h"
#include "tiles/exact_volume.h"
#include "tiles/gather.h"
#include "tiles/tile_plan.h"

namespace leafhull {
namespace {

constexpr int kSnapSteps = 12;

/// A cell's coordinates in the global lattice.
Coord global(Coord local, const Lattice& lattice) {
  return {static_cast<std::int32_t>(lattice.anchor.x + local.x),
          static_cast<std::int32_t>(lattice.anchor.y + local.y),
          static_cast<std::int32_t>(lattice.anchor.z + local.z)};
}

/// Whether a vertex may be shared with another tile: another's, or in the lowest layer of cells.
class Border {
 public:
  Border(const OwnedPolygons& part, const SampleBox& own) : part_(part), own_(own) {}

  bool borrowed(std::uint32_t v) const { return v >= part_.own; }
  bool lent(std::uint32_t v) const {
    const Coord c = cell_of(Vec3d(part_.polygons.points[v]));
    return !borrowed(v) && (c.x == own_.low.x || c.y == own_.low.y || c.z == own_.low.z);
  }

 private:
  const OwnedPolygons& part_;
  const SampleBox& own_;
};

/// Removes the pieces for which `stays` is false; `root` gives the piece of each point. The order
/// is kept.
template <class Stays>
void keep(OwnedPolygons& part, std::vector<std::uint32_t>& root, Stays&& stays) {
  Polygons& polygons = part.polygons;
  const auto points = static_cast<std::uint32_t>(polygons.points.size());
  std::vector<std::uint32_t> moved_to(points);
  std::erase_if(polygons.faces, [&](const auto& face) { return !stays(root[face[0]]); });
  std::uint32_t next = 0, own = 0;
  for (std::uint32_t v = 0; v < points; ++v) {
    if (!stays(root[v])) continue;
    polygons.points[next] = polygons.points[v];
    part.patches[next] = part.patches[v];
    root[next] = root[v];
    moved_to[v] = next++;
    if (v < part.own) own = next;
  }
  part.own = own;
  polygons.points.resize(next);
  part.patches.resize(next);
  root.resize(next);
  for (auto& face : polygons.faces) {
    for (std::uint32_t& v : face) v = moved_to[v];
  }
}

/// Drops what is small and within the tile, and lists what reaches the seams.
void sort_out_pieces(OwnedPolygons& part, const ForestLevel& level, const Lattice& lattice,
                     const SampleBox& own, TileSurface& surface) {
  const auto magnitude = [](ExactVolume v) { return v < 0 ? -v : v; };
  const Border border(part, own);
  std::vector<std::uint32_t> root = component_of_each(part.polygons);
  const auto volumes = exact_volumes(part.polygons, lattice, root);
  std::vector<bool> reaches(root.size(), false), small(root.size(), false);
  for (std::uint32_t v = 0; v < root.size(); ++v) {
    if (border.borrowed(v) || border.lent(v)) reaches[root[v]] = true;
  }
  for (const auto& [piece, volume] : volumes) {
    small[piece] = !reaches[piece] && magnitude(volume) < level.least;
    if (small[piece]) ++surface.dropped_components;
  }
  if (surface.dropped_components > 0) {
    keep(part, root, [&](std::uint32_t piece) { return !small[piece]; });
  }

  std::unordered_map<std::uint32_t, std::uint32_t> component;
  const auto points = static_cast<std::uint32_t>(root.size());
  for (std::uint32_t v = 0; v < points; ++v) {
    if (!border.borrowed(v) && !border.lent(v)) continue;
    const auto [entry, added] =
        component.try_emplace(root[v], static_cast<std::uint32_t>(surface.components.size()));
    if (added) surface.components.push_back({.vertex = v, .volume = 0});
    (border.borrowed(v) ? surface.borrowed : surface.lent)
        .push_back({.cell = global(cell_of(Vec3d(part.polygons.points[v])), lattice),
                    .patch = part.patches[v],
                    .vertex = v,
                    .component = entry->second});
  }
  for (const auto& [piece, volume] : volumes) {
    const auto entry = component.find(piece);
    if (entry != component.end()) surface.components[entry->second].volume = volume;
  }
  std::sort(surface.borrowed.begin(), surface.borrowed.end());
  std::sort(surface.lent.begin(), surface.lent.end());
}

/// Positions in scene units on a grid of a power of two, a thousandth of a voxel or less, from an
/// origin on a coarse grid, such that origin and position are exact and so is their sum: floats
/// have 24 bits.
class SceneGrid {
 public:
  SceneGrid(const Lattice& lattice, Vec3d middle)
      : lattice_(lattice), step_(std::exp2(std::floor(std::log2(lattice.voxel_size / 1024)))) {
    const double coarse = std::ldexp(step_, 24);
    const auto nearest = [&](double v) { return std::round(v / coarse) * coarse; };
    origin_ = {nearest(middle.x), nearest(middle.y), nearest(middle.z)};
  }

  Vec3d origin() const { return origin_; }
  Vec3f operator()(Vec3d local) const {
    const Vec3d w = lattice_.world(local);
    const auto nearest = [&](double v) { return std::round(v / step_) * step_; };
    return Vec3f(Vec3d(nearest(w.x), nearest(w.y), nearest(w.z)) - origin_);
  }

 private:
  const Lattice& lattice_;
  double step_;
  Vec3d origin_;
};

/// Makes a tile's surface from the polygons of its cells: drops small pieces that end within the
/// tile, moves vertices onto N = T, and lists what reaches a seam.
void finish_tile(OwnedPolygons part, DensityFunction& density, const ForestLevel& level,
                 const Lattice& lattice, const SampleBox& own, TileSurface& surface) {
  sort_out_pieces(part, level, lattice, own, surface);
  Polygons& polygons = part.polygons;
  surface.own_vertices = part.own;
  Mesh& mesh = surface.mesh;
  mesh.colour = level.colour;

  std::vector<Vec3d> points(polygons.points.size());
  std::transform(polygons.points.begin(), polygons.points.end(), points.begin(),
                 [](Vec3f p) { return Vec3d(p); });
  mesh.normals =
      density.snap(std::span(points), level.threshold, level.options.snap ? kSnapSteps : 0);
  for (Vec3f& normal : mesh.normals) {
    if (normal == Vec3f{}) normal = {0, 1, 0};  // the gradient vanishes: any will do
  }
  const SceneGrid grid(lattice, lattice.world(0.5 * to_vec3d(own.low + own.high)));
  mesh.origin = grid.origin();
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t v) { polygons.points[v] = grid(points[v]); });
  mesh.triangles = triangulate(polygons);
  mesh.positions = std::move(polygons.points);
}

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
