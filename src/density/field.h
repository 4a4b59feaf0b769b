// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "density/lattice.h"
#include "leafhull/shape.h"

namespace leafhull {

/// A bit per sample of a brick: a word per x, bit 8 y + z.
using SampleBits = std::array<std::uint64_t, kBrickEdge>;

/// Some samples of an evaluated brick, which is known by its index in bricks_of().
struct BrickPart {
  std::size_t brick;
  SampleBits samples;
};

/// The density N on the lattice: samples where a surface may be, whole blocks where N is proven to
/// be at least a threshold, and nothing where it is proven to be below all.
class Shape::Field {
 public:
  explicit Field(const Lattice& lattice = {}, double threshold = 0);

  /// Takes evaluated bricks: N, kBrickSamples per origin, z fastest.
  void add_bricks(std::span<const Coord> origins, std::span<const float> samples);
  /// Takes blocks that are proven inside, disjoint from each other and from the bricks.
  void add_inside(std::span<const InsideBlock> blocks);

  /// The same samples with the surface at another threshold that they were evaluated for.
  Field at(double threshold) const;

  /// Raises samples that are below T, and blocks that are neither evaluated nor inside, to the
  /// lowest value inside, for this threshold alone. Fields that share the grid do not change.
  void raise(std::span<const BrickPart> parts, std::span<const Block> blocks);

  const Lattice& lattice() const { return lattice_; }
  double threshold() const { return threshold_; }  ///< T

  /// The surface's value in the grid of -N (density/field_grid.h): N >= T is -N < iso_value().
  float iso_value() const;
  /// The OpenVDB grid, for files that include density/field_grid.h.
  struct Grid;
  const Grid& grid() const { return *grid_; }
  /// The blocks that are proven inside.
  std::vector<Block> inside() const;

  std::size_t sample_count() const;
  /// The highest N evaluated, at least 0.
  float highest() const;

 private:
  void own_grid();

  Lattice lattice_;
  double threshold_;
  std::shared_ptr<Grid> grid_;  ///< fields of other thresholds share it
  std::vector<InsideBlock> inside_;
};
using Field = Shape::Field;

/// The lowest value of a sample inside. It also fills blocks that are proven inside.
float inside_value(double threshold);

}  // namespace leafhull
