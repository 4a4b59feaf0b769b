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
  std::vector<std::int32_t> roots;     ///< kOutside, kInside or its first child; z fastest
  std::vector<std::int32_t> children;  ///< kOutside, kInside or a brick's index in the field
  std::vector<float> samples;          ///< N, kBrickSamples to a brick
  /// By brick: `drawn` has the cells in which the surface is drawn, which are those that it crosses
  /// on the lattice and their neighbours; `near` adds one more round of neighbours.
  std::vector<CellBits> drawn, near;

  /// Draws the whole surface that the lattice resolves.
  /// @throws Error usage where the field is spread over too many root blocks.
  explicit BrickGrid(const Field& field);

  /// What holds a cell: kOutside, kInside or a brick's index in the field.
  std::int32_t content(Coord cell) const;

  /// Draws the surface only in and around the cells `kept`, and never in cells of `dropped` that
  /// are not kept.
  void draw_only(std::span<const Coord> kept, std::span<const Coord> dropped);

 private:
  std::int32_t& child(Coord cell);
  std::vector<CellBits> crossed(float threshold) const;
  std::vector<CellBits> with_neighbours(const std::vector<CellBits>& cells) const;

  std::vector<Coord> origins_;  ///< of the bricks
};

}  // namespace leafhull
