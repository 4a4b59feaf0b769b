// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openvdb/openvdb.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "density/lattice.h"

namespace leafhull {

/// A bit per sample of a brick: a word per x, bit 8 y + z.
using SampleBits = std::array<std::uint64_t, kBrickEdge>;

/// Some samples of an evaluated brick, by its place in Field::bricks().
struct BrickPart {
  std::size_t brick;
  SampleBits samples;
};

/// The density N on the lattice: samples where a surface may be, whole blocks where N is proven to
/// be at least a threshold, and nothing where it is proven to be below all.
class Field {
 public:
  using Brick = openvdb::FloatTree::LeafNodeType;

  explicit Field(const Lattice& lattice = {}, double threshold = 0)
      : lattice_(lattice), threshold_(threshold) {}

  /// Takes evaluated bricks: N, kBrickSamples per origin, z fastest.
  void add_bricks(std::span<const Coord> origins, std::span<const float> samples);
  /// Takes blocks that are proven inside, disjoint from each other and from the bricks.
  void add_inside(std::span<const InsideBlock> blocks);

  /// The same samples with the surface at another of the thresholds that they were evaluated for.
  Field at(double threshold) const;

  /// Raises samples that are below T, and blocks that are neither evaluated nor inside, to the
  /// lowest value inside, for this threshold alone. Where fields share a grid, the others keep what
  /// they have.
  void raise(std::span<const BrickPart> parts, std::span<const Block> blocks);

  const Lattice& lattice() const { return lattice_; }
  double threshold() const { return threshold_; }  ///< T

  /// -N in voxels from the anchor, the sign that OpenVDB's mesher asks for: what is below the
  /// iso-value is inside. Evaluated samples are active, what is proven inside is tiles.
  const openvdb::FloatGrid& negated() const { return *negated_; }
  /// Where the surface is in `negated()`: N >= T is -N < iso_value().
  float iso_value() const;
  /// The evaluated bricks, leaf nodes of `negated()`, in the order of their evaluation.
  std::span<const Brick* const> bricks() const { return bricks_; }
  /// What is proven inside.
  std::vector<Block> inside() const;

  std::size_t sample_count() const { return bricks_.size() * kBrickSamples; }
  /// The highest N evaluated, at least 0.
  float highest() const;

 private:
  void own_grid();

  Lattice lattice_;
  double threshold_;
  openvdb::FloatGrid::Ptr negated_ = openvdb::FloatGrid::create(0.0f);
  std::vector<Brick*> bricks_;
  std::vector<InsideBlock> inside_;
};

/// The lowest value of a sample inside, which stands for what is proven inside.
float inside_value(double threshold);

/// The samples of a block.
inline openvdb::CoordBBox samples_of(const Block& block) {
  const Coord o = block.origin;
  return openvdb::CoordBBox::createCube(openvdb::Coord(o.x, o.y, o.z), block.edge);
}

}  // namespace leafhull
