// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "surface/polygonise.h"

namespace leafhull {

struct ComponentCount {
  std::uint64_t kept = 0, dropped = 0;
  /// The cells that hold vertices of dropped components other than hollows; ascending, none twice.
  std::vector<Coord> dropped_cells;
};

/// Drops the connected components of a closed mesh whose enclosed volume is below `smallest` times
/// the largest one's; the order of what stays is kept. A hollow inside another component is a
/// component of its own, measured by the volume it takes away.
ComponentCount drop_small_components(Polygons& polygons, double smallest);

/// For each point the lowest one that it is connected to.
std::vector<std::uint32_t> component_of_each(const Polygons& polygons);

/// The lattice cells that hold the vertices of components which drop_small_components would keep,
/// and of those that it would drop.
struct ComponentCells {
  std::vector<Coord> kept, dropped;
};
ComponentCells cells_of_components(const Polygons& polygons, double smallest);

}  // namespace leafhull
