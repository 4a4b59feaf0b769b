// SPDX-License-Identifier: Apache-2.0
#include "density/band.h"

#include "density/batches.h"

namespace leafhull {

std::vector<Block> find_band(const KernelSet& kernels, const BandOptions& options,
                             const BandVisitor& visit) {
  const std::vector<Coord> roots = kernels.root_blocks(options.margin);
  std::vector<Block> inside;

  struct Found {
    BrickList bricks;
    std::vector<Block> inside;
  };
  const auto search = [&](Descent& descent, Coord root, Found& found) {
    const auto enter = [](const Block&) { return true; };
    const auto decide = [&](const Block& block, std::span<const std::uint32_t> near,
                            const Descent::Bounds& bounds) {
      if (near.empty()) return false;
      if (bounds.high < options.lowest) return false;
      if (bounds.low >= options.highest) {
        found.inside.push_back(block);
        return false;
      }
      if (block.edge == kBrickEdge) found.bricks.add(block.origin, near);
      return true;
    };
    descent.from(root, enter, decide);
  };
  const auto flush = [&](Found& found, double done) {
    if (found.bricks.size() > 0) visit(found.bricks, done);
    inside.insert(inside.end(), found.inside.begin(), found.inside.end());
  };
  const auto join = [](Found& all, const Found& found) {
    all.bricks.append(found.bricks);
    all.inside.insert(all.inside.end(), found.inside.begin(), found.inside.end());
  };
  in_batches<Found>(
      roots, [&] { return Descent(kernels, options.falloff, options.margin); }, search, join,
      flush);
  return inside;
}

}  // namespace leafhull
