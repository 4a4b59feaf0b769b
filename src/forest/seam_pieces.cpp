// SPDX-License-Identifier: Apache-2.0
#include "forest/seam_pieces.h"

#include <numeric>
#include <utility>

namespace leafhull {
namespace {

/// The components of all tiles, numbered through, in sets of those that are one piece.
class Pieces {
 public:
  std::size_t add(ExactVolume volume) {
    parent_.push_back(parent_.size());
    volume_.push_back(volume);
    return parent_.back();
  }
  std::size_t root(std::size_t c) {
    while (parent_[c] != c) c = parent_[c] = parent_[parent_[c]];
    return c;
  }
  void unite(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    parent_[b] = a;
    volume_[a] += volume_[b];
  }
  /// Without its sign: a hollow is measured by what it takes away.
  ExactVolume volume(std::size_t c) {
    const ExactVolume volume = volume_[root(c)];
    return volume < 0 ? -volume : volume;
  }

 private:
  std::vector<std::size_t> parent_;
  std::vector<ExactVolume> volume_;
};

}  // namespace

DroppedPieces find_small_pieces(const StoredTiles& tiles, const SmallPieces& small) {
  Pieces pieces;
  std::vector<std::size_t> first{0};  // of each tile's components
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const Seam seam = tiles.seam(t);
    for (const SeamComponent& component : seam.components) pieces.add(component.volume);
    first.push_back(first.back() + seam.components.size());
  }
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    for_each_borrowed(
        tiles, t, tiles.seam(t), [&](std::size_t owner) { return tiles.seam(owner); },
        [&](const SeamVertex& borrowed, std::size_t owner, const SeamVertex& lent) {
          pieces.unite(first[owner] + lent.component, first[t] + borrowed.component);
        });
  }

  DroppedPieces dropped;
  dropped.of_tile.resize(tiles.size());
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const auto level = static_cast<std::size_t>(tiles[t].id.level);
    const ExactVolume least = level < small.least.size() ? small.least[level] : 0;
    for (std::size_t c = first[t]; c < first[t + 1]; ++c) {
      if (pieces.volume(c) >= least) continue;
      dropped.of_tile[t].push_back(static_cast<std::uint32_t>(c - first[t]));
      if (pieces.root(c) == c) ++dropped.count;
    }
  }
  return dropped;
}

}  // namespace leafhull
