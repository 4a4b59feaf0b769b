// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "density/lattice.h"
#include "leafhull/shape.h"

namespace leafhull {

/// A cube of cells of the global lattice of its level; `at` counts tiles. Level 0 is the finest,
/// and every level's voxels are twice as large as those of the one below.
struct TileId {
  int level = 0;
  Coord at;
  friend auto operator<=>(const TileId&, const TileId&) = default;
  TileId parent() const { return {level + 1, {at.x >> 1, at.y >> 1, at.z >> 1}}; }
};

/// A volume in 1 / 2^42 voxels, times twelve: exact, so that parts add up in any order.
__extension__ typedef __int128 ExactVolume;  // NOLINT(modernize-use-using)

/// A vertex that two tiles may share: the cell of the global lattice that holds it, and its number
/// among the vertices there.
struct SeamVertex {
  Coord cell;
  std::uint32_t patch = 0;
  std::uint32_t vertex = 0;     ///< in the tile's mesh
  std::uint32_t component = 0;  ///< into TileSurface::components
  std::strong_ordering operator<=>(const SeamVertex& other) const {
    if (const auto c = cell <=> other.cell; std::is_neq(c)) return c;
    return patch <=> other.patch;
  }
  bool operator==(const SeamVertex& other) const { return std::is_eq(*this <=> other); }
};

/// A piece of surface that goes on in another tile.
struct SeamComponent {
  std::uint32_t vertex = 0;  ///< one of its own in the tile's mesh
  ExactVolume volume = 0;    ///< this tile's part
};

/// The surface of a tile: first its own vertices, those in its cells; then those of upper
/// neighbours that its triangles use. The same vertex has the same bits in every tile.
struct TileSurface {
  Mesh mesh;
  std::uint32_t own_vertices = 0;
  /// Vertices that upper neighbours own, then its own in the lowest layer of cells along any axis;
  /// each part ascending.
  std::vector<SeamVertex> borrowed, lent;
  std::vector<SeamComponent> components;  ///< those that reach a seam
  std::uint64_t leaf_vertices = 0;        ///< those whose centre lies in the tile
  std::uint64_t gathered = 0;             ///< kernels, halo included
  std::uint64_t evaluated_voxels = 0;
  std::uint64_t dropped_components = 0;  ///< small pieces within the tile
};

}  // namespace leafhull
