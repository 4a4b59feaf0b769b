// SPDX-License-Identifier: Apache-2.0
#include "tiles/gather.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "tiles/tree_map.h"

namespace leafhull {
namespace {

bool apart(const Box& a, const Box& b, double reach) {
  const auto along = [&](double low, double high, double from, double to) {
    return low > to + reach || from > high + reach;
  };
  return along(a.low.x, a.high.x, b.low.x, b.high.x) ||
         along(a.low.y, a.high.y, b.low.y, b.high.y) || along(a.low.z, a.high.z, b.low.z, b.high.z);
}

/// Calls visit(map, model, j, at) for every kernel of the runs.
template <class Visit>
void for_each_kernel(const ForestLevel& level, std::span<const KernelRun> runs, Visit&& visit) {
  std::vector<std::size_t> first{0};
  for (const KernelRun& run : runs) first.push_back(first.back() + (run.end - run.first));
  tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t r) {
    const KernelRun& run = runs[r];
    const PlacedTree& tree = level.trees[run.tree];
    const TreeMap map(tree);
    for (std::size_t j = run.first; j < run.end; ++j) {
      visit(map, level.models[tree.model], j, first[r] + (j - run.first));
    }
  });
}

}  // namespace

std::vector<KernelRun> runs_near(const ForestLevel& level, std::span<const std::uint32_t> trees,
                                 const Box& box) {
  std::vector<std::vector<KernelRun>> found(trees.size());
  tbb::parallel_for(std::size_t{0}, trees.size(), [&](std::size_t t) {
    const PlacedTree& tree = level.trees[trees[t]];
    const ForestModel& model = level.models[tree.model];
    const TreeMap map(tree);
    std::vector<KernelRun>& runs = found[t];
    for (const KernelGroup& group : model.groups) {
      // Where control depends on the scene, a kernel may grow up to the model's reach.
      const double reach = level.scope == ControlScope::scene ? model.reach : group.reach;
      if (apart(map(group.centres), box, reach * map.stretch())) continue;
      if (!runs.empty() && runs.back().end == group.first) {
        runs.back().end = group.end;
      } else {
        runs.push_back({trees[t], group.first, group.end});
      }
    }
  });
  std::vector<KernelRun> all;
  for (const auto& runs : found) all.insert(all.end(), runs.begin(), runs.end());
  return all;
}

std::size_t count(std::span<const KernelRun> runs) {
  std::size_t sum = 0;
  for (const KernelRun& run : runs) sum += run.end - run.first;
  return sum;
}

std::vector<Vec3d> centres_of(const ForestLevel& level, std::span<const KernelRun> runs) {
  std::vector<Vec3d> centres(count(runs));
  for_each_kernel(level, runs,
                  [&](const TreeMap& map, const ForestModel& model, std::size_t j, std::size_t at) {
                    centres[at] = map(model.leaves[j].position);
                  });
  return centres;
}

std::vector<std::uint64_t> weights_of(const ForestLevel& level, std::span<const KernelRun> runs) {
  std::vector<std::uint64_t> weights(count(runs));
  for_each_kernel(level, runs,
                  [&](const TreeMap& map, const ForestModel& model, std::size_t j, std::size_t at) {
                    weights[at] = weight_of(model.leaves[j].area, map.area(), level.area_unit);
                  });
  return weights;
}

PlacedSamples samples_in(const ForestLevel& level, std::span<const std::uint32_t> trees,
                         const Box& box) {
  PlacedSamples found;
  for (const std::uint32_t t : trees) {
    const PlacedTree& tree = level.trees[t];
    const ForestModel& model = level.models[tree.model];
    const TreeMap map(tree);
    if (apart(map(model.bounds), box, model.reach * map.stretch())) continue;
    const double area = model.area / static_cast<double>(model.samples.size());
    const std::uint64_t weight = weight_of(area, map.area(), level.sample_unit);
    for (std::size_t i = 0; i < model.samples.size(); ++i) {
      const Vec3d p = map(model.samples[i]);
      if (!box.contains(p)) continue;
      found.points.push_back(p);
      found.weights.push_back(weight);
      found.in_solid.push_back(!model.in_solid.empty() && model.in_solid[i]);
    }
  }
  return found;
}

KernelSet placed_kernels(const ForestLevel& level, std::span<const KernelRun> runs,
                         const Lattice& lattice, const KernelOf& kernel) {
  const auto hash = [&] {
    const std::vector<Vec3d> centres = centres_of(level, runs);
    return std::make_shared<const SpatialHash>(
        centres, Lattice::near(lattice.world({0, 0, 0}), level.reach));
  }();
  std::vector<std::uint32_t> rank(count(runs));
  const std::span<const std::uint32_t> order = hash->order();
  tbb::parallel_for(std::size_t{0}, order.size(),
                    [&](std::size_t r) { rank[order[r]] = static_cast<std::uint32_t>(r); });
  std::vector<LatticeKernel> kernels(rank.size());
  for_each_kernel(level, runs,
                  [&](const TreeMap& map, const ForestModel& model, std::size_t j, std::size_t at) {
                    kernels[rank[at]] = map(kernel(model, j, at), lattice, level.options.falloff);
                  });
  return {std::move(kernels), hash, lattice, level.reach / level.voxel_size};
}

}  // namespace leafhull
