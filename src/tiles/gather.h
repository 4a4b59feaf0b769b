// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "density/kernel_set.h"
#include "leafhull/scene.h"
#include "tiles/level.h"

namespace leafhull {

/// Kernels `first` to `end` of a tree's model.
struct KernelRun {
  std::uint32_t tree, first, end;
};

/// The kernels of `trees` whose support may reach `box` (scene units), and some beyond it, ordered
/// by tree and then as in its model, whoever asks.
std::vector<KernelRun> runs_near(const ForestLevel& level, std::span<const std::uint32_t> trees,
                                 const Box& box);

std::size_t count(std::span<const KernelRun> runs);

/// The kernels' centres, in scene units.
std::vector<Vec3d> centres_of(const ForestLevel& level, std::span<const KernelRun> runs);

/// The kernels' weights (weight_of).
std::vector<std::uint64_t> weights_of(const ForestLevel& level, std::span<const KernelRun> runs);

/// Places on the leaves of `trees`, in scene units, and their weights.
struct PlacedSamples {
  std::vector<Vec3d> points;
  std::vector<std::uint64_t> weights;
  std::vector<bool> in_solid;  ///< as in LeafPoints
};

/// The trees' samples that lie in `box`.
PlacedSamples samples_in(const ForestLevel& level, std::span<const std::uint32_t> trees,
                         const Box& box);

/// The kernel at index `j` of its model and index `at` over all runs.
using KernelOf = std::function<Kernel(const ForestModel& model, std::size_t j, std::size_t at)>;

/// The kernels on a lattice, hashed by cells as large as the level's reach. All tiles share one
/// lattice of such cells, so N is the same whatever runs it is summed from.
KernelSet placed_kernels(const ForestLevel& level, std::span<const KernelRun> runs,
                         const Lattice& lattice, const KernelOf& kernel);

}  // namespace leafhull
