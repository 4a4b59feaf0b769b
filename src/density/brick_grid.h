// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "density/field.h"

namespace leafhull {

/// Words of a mask with a bit for each cell of a brick, the cell's number as a sample's.
inline constexpr int kBrickMaskWords = kBrickSamples / 32;

/// A field as rays walk it, the device's own form (`Grid` of rays.cl): a dense box of root blocks,
/// each outside, inside, or 64 bricks that are outside, inside or evaluated.
struct BrickGrid {
  static constexpr std::int32_t kOutside = -1, kInside = -2;
  static constexpr int kChildren = 64;  ///< bricks of a root, z fastest

  Coord low, size;                     ///< roots: the first, and how many along each axis
  std::vector<std::int32_t> roots;     ///< or the first of its children; z fastest
  std::vector<std::int32_t> children;  ///< or an evaluated brick, by its order in the field
  std::vector<float> samples;          ///< N, kBrickSamples to a brick
  std::vector<std::uint32_t> hidden;   ///< cells whose surface is not drawn, kBrickMaskWords each

  /// @throws Error usage where the field is spread over too many root blocks.
  explicit BrickGrid(const Field& field);

  /// What holds a brick's first cell.
  std::int32_t content(Coord cell) const;

  /// Draws only what lies in one of `cells` or a neighbour of one; what is not in `cells` but in
  /// `others` stays hidden.
  void draw_only(std::span<const Coord> cells, std::span<const Coord> others);

 private:
  std::int32_t& child(Coord cell);
};

}  // namespace leafhull
