// SPDX-License-Identifier: Apache-2.0
#include "density/band.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace leafhull {
namespace {

/// A batch is handed over at about 64 MiB of lists, or at 32 Ki bricks.
constexpr std::size_t kBatchEntries = std::size_t{1} << 24;
constexpr std::size_t kBatchBricks = std::size_t{1} << 15;

/// The part of the band that lies in one root block.
struct Found {
  BrickList bricks;
  std::vector<InsideBlock> inside;
};

/// The number of thresholds that are at most `n`.
std::size_t up_to(double n, const std::vector<double>& thresholds) {
  return static_cast<std::size_t>(std::upper_bound(thresholds.begin(), thresholds.end(), n) -
                                  thresholds.begin());
}

Found search(Descent& descent, Coord root, const BandOptions& options) {
  Found found;
  descent.from(root, [&](const Block& block, std::span<const std::uint32_t> near,
                         const Descent::Bounds& bounds) {
    if (near.empty() || (options.range && !options.range->meets(block))) return false;
    const std::size_t reached = up_to(bounds.low, options.thresholds);
    const bool decided = reached == up_to(bounds.high, options.thresholds);
    if (decided && !options.thresholds.empty()) {
      if (reached > 0) found.inside.push_back({block, options.thresholds[reached - 1]});
      return false;
    }
    if (block.edge == kBrickEdge) found.bricks.add(block.origin, near);
    return true;
  });
  return found;
}

}  // namespace

std::vector<InsideBlock> find_band(const KernelSet& kernels, const BandOptions& options,
                                   const BandVisitor& visit) {
  std::vector<Coord> roots = kernels.root_blocks(options.margin);
  if (options.range) {
    std::erase_if(roots, [&](Coord root) { return !options.range->meets({root, kRootEdge}); });
  }
  tbb::enumerable_thread_specific<Descent> descents(
      [&] { return Descent(kernels, options.falloff, options.margin); });
  std::vector<InsideBlock> inside;
  BrickList batch;
  std::size_t group = 4;  // roots searched at once
  for (std::size_t begin = 0, end = 0; begin < roots.size(); begin = end) {
    end = std::min(begin + group, roots.size());
    std::vector<Found> found(end - begin);
    tbb::parallel_for(begin, end, [&](std::size_t r) {
      found[r - begin] = search(descents.local(), roots[r], options);
    });
    std::size_t longest = 1;
    for (const Found& one : found) {
      batch.append(one.bricks);
      inside.insert(inside.end(), one.inside.begin(), one.inside.end());
      longest = std::max(longest, one.bricks.kernels.size());
    }
    if (batch.kernels.size() >= kBatchEntries || batch.size() >= kBatchBricks) {
      visit(batch, static_cast<double>(end) / static_cast<double>(roots.size()));
      batch = {};
    }
    group = std::clamp<std::size_t>(kBatchEntries / longest, 1, 4 * group);
  }
  if (batch.size() > 0) visit(batch, 1.0);
  return inside;
}

}  // namespace leafhull
