// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "leafhull/scene.h"
#include "tiles/level.h"
#include "tiles/tile.h"

namespace leafhull {

/// Cells along a tile by default.
inline constexpr int kTileEdge = 128;
/// The most tiles that are computed at once.
inline constexpr int kTilesAtOnce = 2;

/// A tile to compute: `trees` are those that may reach it, ascending.
struct TileTask {
  TileId id;
  int edge = kTileEdge;  ///< cells
  std::span<const std::uint32_t> trees;
};

/// The tiles of a level and the trees that reach each.
class TilePlan {
 public:
  /// `edge`: cells along a tile.
  TilePlan(const ForestLevel& level, int edge);

  std::size_t size() const { return tiles_.size(); }
  /// The tiles, ascending.
  std::span<const TileId> tiles() const { return tiles_; }
  /// The trees whose density may reach tile `t` or the samples around it, or, in control over the
  /// scene, the kernels that do; ascending.
  std::span<const std::uint32_t> trees(std::size_t t) const {
    return std::span(trees_).subspan(first_[t], first_[t + 1] - first_[t]);
  }
  TileTask task(std::size_t t) const { return {tiles_[t], edge_, trees(t)}; }
  /// About how many kernels these trees have there.
  double weight(std::size_t t) const { return weights_[t]; }
  double heaviest() const;

 private:
  int edge_;
  std::vector<TileId> tiles_;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> trees_;
  std::vector<float> weights_;
};

/// Cells along a tile: `asked`, or 128, or less where the heaviest tile would not fit in `memory`
/// beside the models. @throws Error usage: it does not fit in any case.
int tile_edge(std::span<const ForestLevel> levels, std::optional<int> asked, std::uint64_t memory,
              const std::filesystem::path& folder);

/// The samples of a tile and a brick around it, from the tile's lowest cell.
SampleBox samples_around(int edge);
/// The lattice of a level anchored at a tile, whose cells are then [0, edge) along each axis.
Lattice tile_lattice(const TileId& tile, double voxel_size, int edge);

}  // namespace leafhull
