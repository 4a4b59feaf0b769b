// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "density/lattice.h"

namespace leafhull {

/// The density N on the lattice: samples where the surface may be, whole blocks where it is proven
/// to be at least the threshold, and nothing where it is proven to be below.
class Field {
 public:
  Lattice lattice;
  double threshold = 0;        ///< T
  std::vector<Coord> origins;  ///< of the evaluated bricks, each once
  std::vector<float> samples;  ///< N, kBrickSamples per brick, z fastest
  std::vector<Block> inside;   ///< proven inside, disjoint from each other and from the bricks
};

}  // namespace leafhull
