// SPDX-License-Identifier: Apache-2.0
#include "tiles/level.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "leafhull/error.h"
#include "pipeline/evaluate.h"
#include "pipeline/grid.h"
#include "pipeline/sliders.h"
#include "surface/brick_mesher.h"
#include "tiles/exact_volume.h"
#include "tiles/tree_map.h"

namespace leafhull {
namespace {

constexpr std::uint32_t kGroup = 64;
/// Shares of leaf area are counted in steps of 2^-40, areas in steps of the mean one over 2^10.
constexpr int kShareBits = 40, kAreaBits = 10;
/// A model is not thinned below this many leaf vertices.
constexpr std::size_t kFewest = 64;
/// The most voxels along a model while its volume is taken, to save memory.
constexpr double kMostVoxels = 128;

/// The leaf vertices of a level; those of a model are in Morton order, so that every n-th is spread
/// evenly. Parts of leaf area need no thinning: they grow with R_max.
LeafSet thinned(const LeafSet& leaves, int level, PointSource points) {
  if (level == 0 || points == PointSource::area) return leaves;
  LeafSet few = leaves;
  few.vertices.clear();
  const std::size_t most = std::max<std::size_t>(1, leaves.vertices.size() / kFewest);
  const std::size_t step = std::min(std::size_t{1} << 2 * level, most);
  const double grown = std::ldexp(1.0, level);
  for (std::size_t i = step / 2; i < leaves.vertices.size(); i += step) {
    LeafVertex leaf = leaves.vertices[i];
    leaf.radius_major *= static_cast<float>(grown);
    leaf.radius_minor *= static_cast<float>(grown);
    few.vertices.push_back(leaf);
  }
  few.mean_radius_major *= grown;
  return few;
}

std::vector<KernelGroup> groups_of(std::span<const Kernel> kernels) {
  std::vector<KernelGroup> groups;
  const auto count = static_cast<std::uint32_t>(kernels.size());
  for (std::uint32_t first = 0; first < count; first += kGroup) {
    KernelGroup group{
        .centres = {}, .reach = 0, .first = first, .end = std::min(first + kGroup, count)};
    for (const Kernel& k : kernels.subspan(first, group.end - first)) {
      group.centres.include(k.centre);
      group.reach =
          std::max({group.reach, static_cast<double>(k.radius_major),
                    static_cast<double>(k.radius_minor), static_cast<double>(k.radius_normal)});
    }
    groups.push_back(group);
  }
  return groups;
}

/// The options of a model that stands alone at a level.
Options alone(const LeafSet& leaves, int level, Options resolved) {
  // Neither kernels nor densities depend on the voxels.
  resolved.preset = Preset::standard;
  resolved.resolution.reset();
  resolved.voxel_size.reset();
  resolved.radius_max = radius_max_in_model_units(leaves, resolved) * std::ldexp(1.0, level);
  resolved.radius_unit = RadiusUnit::model;
  resolved.dilation.reset();  // it has found R_max
  return resolve(resolved);
}

ForestModel prepare_model(const LeafSet& all, int level, const Options& resolved, Device& device) {
  const Progress no_progress;
  Stopwatch watch(no_progress);
  const LeafSet leaves = thinned(all, level, *resolved.points);
  const Run run{leaves, device, watch};
  const Options options = alone(all, level, resolved);
  Prepared prepared = Stages(run).prepare(options, options.erosion.value_or(0));

  ForestModel model;
  model.kernels = taken(std::move(prepared.kernels));
  if (resolved.erosion) {
    for (Kernel& k : model.kernels) {
      k.weight = static_cast<float>(static_cast<double>(k.weight) / prepared.threshold);
    }
  }
  model.isotropic_density = taken(std::move(prepared.isotropic_density));
  model.density = taken(std::move(prepared.there));
  LeafPoints points = taken(std::move(prepared.points));
  model.leaves = std::move(points.points);
  model.samples = std::move(points.samples);
  model.in_solid = std::move(points.in_solid);
  model.area = points.area;
  model.radius_max = prepared.grid.radius_max;
  model.groups = groups_of(model.kernels);
  for (const Kernel& k : model.kernels) model.bounds.include(k.centre);
  model.crown = leaves.crown;
  model.reach = prepared.grid.radius_max;
  return model;
}

std::uint64_t whole(double weight) {
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(weight)));
}

double weighted_mean(const std::vector<ForestModel>& models, std::span<const ModelUse> uses) {
  double sum = 0, count = 0;
  for (std::size_t m = 0; m < models.size(); ++m) {
    const ForestModel& model = models[m];
    for (std::size_t j = 0; j < model.leaves.size(); ++j) {
      if (!model.crown.contains(model.leaves[j].position)) continue;
      const double area = model.leaves[j].area;
      const double weight = area > 0 ? area * uses[m].area : static_cast<double>(uses[m].trees);
      sum += weight * static_cast<double>(model.isotropic_density[j]);
      count += weight;
    }
  }
  return sum / count;
}

double threshold_of(const ForestLevel& level, std::span<const ModelUse> uses,
                    const ForestLevel* finest) {
  const Options& options = level.options;
  if (options.erosion) return 1;
  if (options.coverage) {
    double all_area = 0;
    for (std::size_t m = 0; m < level.models.size(); ++m) {
      all_area += level.models[m].area * uses[m].area;
    }
    std::vector<WeightedDensity> densities;
    for (std::size_t m = 0; m < level.models.size(); ++m) {
      const ForestModel& model = level.models[m];
      std::uint64_t weight = uses[m].trees;
      if (model.area > 0) {
        const double share = model.area * uses[m].area / all_area;
        weight = whole(std::ldexp(share / static_cast<double>(model.density.size()), kShareBits));
      }
      for (std::size_t i = 0; i < model.density.size(); ++i) {
        const bool in_solid = !model.in_solid.empty() && model.in_solid[i];
        densities.push_back({model.density[i], weight, in_solid});
      }
    }
    if (options.points == PointSource::vertices) {
      return threshold_for_coverage(densities, *options.coverage);
    }
    // Where all weights are equal, each becomes one, as in an extraction.
    std::uint64_t unit = 0;
    for (const WeightedDensity& d : densities) unit = std::gcd(unit, d.weight);
    for (WeightedDensity& d : densities) d.weight /= unit;
    const double threshold = threshold_for_coverage(densities, *options.coverage);
    return clear_of_sheets(densities, threshold, *options.coverage);
  }
  const double mean = weighted_mean(level.models, uses);
  if (options.threshold_percent) return *options.threshold_percent / 100 * mean;
  if (!finest) return *options.threshold;
  return *options.threshold * mean / weighted_mean(finest->models, uses);
}

/// Twelve times the volume of a model's largest piece, standing alone, in voxels of the level;
/// measured on voxels no smaller than a share of the tree, so that it takes no more memory than a
/// tile.
double largest_piece(const ForestModel& model, const ForestLevel& level, Device& device) {
  const double side = model.crown.longest_side() + 2 * model.reach;
  const double voxel_size = std::max(level.voxel_size, side / kMostVoxels);
  const Lattice lattice = Lattice::near(model.bounds.low, voxel_size);
  const auto hash = std::make_shared<const SpatialHash>(
      model.kernels, Lattice::near(model.bounds.low, std::max(model.reach, side / kMostVoxels)));
  DensityFunction density(device, model.kernels, hash, lattice, level.options.falloff);
  const auto sampled = density.sample_band({level.threshold}, 1, false,
                                           DensityFunction::Lists::forget, [](double) {});
  double largest = 0;
  for (const auto& [root, volume] : exact_volumes(mesh_bricks(sampled.field), lattice)) {
    largest = std::max(largest, std::fabs(static_cast<double>(volume)));
  }
  return largest * std::pow(voxel_size / level.voxel_size, 3);
}

std::optional<Vec3f> mean_colour(std::span<const LeafSet> models, std::span<const ModelUse> uses) {
  Vec3d sum;
  double area = 0;
  for (std::size_t m = 0; m < models.size(); ++m) {
    if (!models[m].colour) continue;
    const double share = models[m].area * uses[m].area;
    sum = sum + Vec3d(*models[m].colour) * share;
    area += share;
  }
  return area > 0 ? std::optional(Vec3f(sum / area)) : std::nullopt;
}

}  // namespace

Options resolved_shape(const ForestOptions& options) {
  Options resolved = resolve(options.shape);
  if (options.merge == Merge::canopy) resolved.hollows = Hollows::keep;
  return resolved;
}

std::vector<ModelUse> model_uses(const Scene& scene) {
  std::vector<ModelUse> uses(scene.models.size());
  for (const PlacedTree& tree : scene.trees) {
    ModelUse& use = uses[tree.model];
    const TreeMap map(tree);
    use.smallest_volume =
        use.trees == 0 ? map.volume() : std::min(use.smallest_volume, map.volume());
    use.largest = std::max(use.largest, map.stretch());
    use.area += map.area();
    ++use.trees;
  }
  return uses;
}

std::vector<LeafSet> read_models(const Scene& scene, std::span<const ModelUse> uses,
                                 const LeafOptions& options) {
  std::vector<LeafSet> models(scene.models.size());
  for (std::size_t m = 0; m < models.size(); ++m) {
    if (uses[m].trees == 0) continue;
    models[m] = read_model(scene.models[m], options);
  }
  return models;
}

std::vector<Options> shapes_of(std::span<const LeafSet> models, std::span<const ModelUse> uses,
                               const Options& resolved, Device& device) {
  std::vector<Options> shapes(models.size(), resolved);
  for (std::size_t m = 0; m < models.size() && resolved.dilation; ++m) {
    if (uses[m].trees == 0) continue;
    const Progress no_progress;
    Stopwatch watch(no_progress);
    const Run run{models[m], device, watch};
    Stages stages(run);
    Sliders sliders(run, stages, resolved);
    const Prepared prepared = sliders.prepare();
    sliders.check_dilation(prepared);
    shapes[m].radius_max = prepared.options.radius_max;
  }
  return shapes;
}

double voxel_size_of(std::span<const LeafSet> models, std::span<const ModelUse> uses,
                     std::span<const Options> shapes) {
  if (shapes.front().voxel_size) return *shapes.front().voxel_size;
  double side = 0;
  for (std::size_t m = 0; m < models.size(); ++m) {
    if (uses[m].trees == 0) continue;
    const double radius = radius_max_in_model_units(models[m], shapes[m]);
    side = std::max(side, uses[m].largest * (models[m].crown.longest_side() + 2 * radius));
  }
  return side / *shapes.front().resolution;
}

ForestLevel prepare_level(int number, const Scene& scene, std::span<const LeafSet> models,
                          std::span<const Options> shapes, double voxel_size,
                          const ForestLevel* finest, Device& device) {
  const std::vector<ModelUse> uses = model_uses(scene);
  ForestLevel level;
  level.level = number;
  level.trees = scene.trees;
  level.options = shapes.front();
  level.voxel_size = std::ldexp(voxel_size, number);
  level.models.resize(models.size());
  double radius_max = 0;
  for (std::size_t m = 0; m < models.size(); ++m) {
    if (uses[m].trees == 0) continue;
    level.models[m] = prepare_model(models[m], number, shapes[m], device);
    level.reach = std::max(level.reach, level.models[m].reach * uses[m].largest);
    radius_max = std::max(radius_max, level.models[m].radius_max * uses[m].largest);
  }
  double area = 0, points = 0, samples = 0;
  for (const ForestModel& model : level.models) {
    area += model.area;
    points += static_cast<double>(model.leaves.size());
    samples += static_cast<double>(model.samples.size());
  }
  level.area_unit = area / points;
  level.sample_unit = area / samples;
  level.threshold = threshold_of(level, uses, finest);
  level.colour = mean_colour(models, uses);
  // The error is a voxel plus the growth of R_max since level 0.
  level.error = level.voxel_size + radius_max * (1 - std::ldexp(1.0, -number));
  return level;
}

std::uint64_t weight_of(double area, double growth, double mean_area) {
  return area == 0 ? 1 : whole(std::ldexp(area * growth / mean_area, kAreaBits));
}

ExactVolume least_volume(const ForestLevel& level, std::span<const ModelUse> uses, Device& device) {
  const double share = *level.options.min_component;
  if (share == 0) return 0;
  double smallest = HUGE_VAL;
  for (std::size_t m = 0; m < level.models.size(); ++m) {
    if (uses[m].trees == 0) continue;
    const double alone = largest_piece(level.models[m], level, device);
    if (alone > 0) smallest = std::min(smallest, alone * uses[m].smallest_volume);
  }
  return smallest < HUGE_VAL ? static_cast<ExactVolume>(share * smallest) : 0;
}

double threshold_for_coverage(std::vector<WeightedDensity>& densities, double coverage) {
  std::sort(densities.begin(), densities.end(),
            [](const auto& a, const auto& b) { return a.density < b.density; });
  std::uint64_t count = 0;
  for (const WeightedDensity& d : densities) count += d.weight;
  const auto below = std::min(
      count - 1,
      static_cast<std::uint64_t>(std::llround((1 - coverage) * static_cast<double>(count))));
  std::uint64_t rank = 0;  // the rank of the first with a density
  std::size_t at = 0;
  while (rank + densities[at].weight <= below) rank += densities[at++].weight;
  const auto here = static_cast<double>(densities[at].density);
  if (below == 0 || rank < below) return here;
  return 0.5 * (static_cast<double>(densities[at - 1].density) + here);
}

}  // namespace leafhull
