// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "density/field.h"

namespace leafhull {

/// A bit per cell of a brick: a word per x, bit 8 y + z.
using CellBits = std::array<std::uint64_t, kBrickEdge>;

/// A field as rays walk it, the device's own form (`Grid` of rays.cl): a dense box of root blocks,
/// each outside, inside, or 64 bricks that are outside, inside or evaluated.
struct BrickGrid {
  static constexpr std::int32_t kOutside = -1, kInside = -2;
  static constexpr int kChildren = 64;  ///< bricks of a root, z fastest

  Coord low, size;                     ///< roots: the first, and how many along each axis
  std::vector<std::int32_t> roots;     ///< or the first of its children; z fastest
  std::vector<std::int32_t> children;  ///< or an evaluated brick, by its order in the field
  std::vector<float> samples;          ///< N, kBrickSamples to a brick
  /// By brick: the cells in which the surface is drawn, those that it crosses on the lattice and
  /// their neighbours; and the same with one more round of neighbours.
  std::vector<CellBits> drawn, near;

  /// Draws all of the surface that the lattice sees.
  /// @throws Error usage where the field is spread over too many root blocks.
  explicit BrickGrid(const Field& field);

  /// What holds a cell.
  std::int32_t content(Coord cell) const;

  /// Draws only the surface in the cells `kept` and around, and none in those of `dropped` that are
  /// not kept.
  void draw_only(std::span<const Coord> kept, std::span<const Coord> dropped);

 private:
  std::int32_t& child(Coord cell);
  std::vector<CellBits> crossed(float threshold) const;
  std::vector<CellBits> with_neighbours(const std::vector<CellBits>& cells) const;

  std::vector<Coord> origins_;  ///< of the bricks
};

}  // namespace leafhull
