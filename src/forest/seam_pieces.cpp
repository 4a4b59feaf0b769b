// SPDX-License-Identifier: Apache-2.0
#include "forest/seam_pieces.h"

#include <utility>

#include "surface/disjoint_sets.h"

namespace leafhull {

DroppedPieces find_small_pieces(const StoredTiles& tiles, const SmallPieces& small) {
  std::vector<ExactVolume> volumes;     // of all tiles' components, in one sequence
  std::vector<std::uint32_t> first{0};  // each tile's first component in it
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    for (const SeamComponent& component : tiles.seam(t).components) {
      volumes.push_back(component.volume);
    }
    first.push_back(static_cast<std::uint32_t>(volumes.size()));
  }
  DisjointSets sets(volumes.size());
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    for_each_borrowed(tiles, t, tiles.seam(t),
                      [&](const SeamVertex& borrowed, std::size_t owner, const SeamVertex& lent) {
                        sets.unite(first[owner] + lent.component, first[t] + borrowed.component);
                      });
  }
  const std::vector<std::uint32_t> piece = std::move(sets).lowest();
  std::vector<ExactVolume> whole(volumes.size(), 0);
  for (std::size_t c = 0; c < piece.size(); ++c) whole[piece[c]] += volumes[c];

  DroppedPieces dropped;
  dropped.of_tile.resize(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const auto level = static_cast<std::size_t>(tiles[t].record.level);
    const ExactVolume least = level < small.least.size() ? small.least[level] : 0;
    for (std::uint32_t c = first[t]; c < first[t + 1]; ++c) {
      const ExactVolume volume = whole[piece[c]];  // a hollow's volume is negative
      if (volume >= least || -volume >= least) continue;
      dropped.of_tile[t].push_back(c - first[t]);
      if (piece[c] == c) ++dropped.count;
    }
  }
  return dropped;
}

}  // namespace leafhull
