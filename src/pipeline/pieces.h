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
  std::vector<Coord> dropped_cells;  ///< as in ComponentCount
};

Pieces polygonise(const Run& run, const Field& field, const Options& resolved);

}  // namespace leafhull
