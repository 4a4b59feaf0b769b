// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/run.h"
#include "surface/polygonise.h"

namespace leafhull {

/// Step 7 of Figure 8: a field's surface without its small components.
struct Pieces {
  Polygons polygons;  ///< none where no sample reaches T
  std::uint64_t kept = 0, dropped = 0;
  std::vector<Coord> dropped_cells;  ///< as ComponentCount has them
};

/// `mesher` is for surfaces without adaptivity; both give the same vertices and quads, in orders of
/// their own.
Pieces polygonise(const Run& run, const Field& field, const Options& resolved, Mesher mesher);

}  // namespace leafhull
