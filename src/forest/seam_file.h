// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "tiles/tile.h"

namespace leafhull {

/// What a tile shares with its neighbours.
struct Seam {
  std::uint32_t own_vertices = 0;
  std::vector<SeamVertex> borrowed, lent;
  std::vector<SeamComponent> components;
  /// Where the tile has no triangles, its vertices, which only lower neighbours use.
  Mesh loose;

  /// Whether there is nothing to keep.
  bool empty() const {
    return borrowed.empty() && lent.empty() && components.empty() && loose.positions.empty();
  }
};

void write_seam(const Seam& seam, std::ostream& stream);

/// @throws Error input: the bytes are no seam.
Seam read_seam(std::string_view bytes, const std::string& where);

}  // namespace leafhull
