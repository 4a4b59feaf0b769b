// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "leafhull/leaves.h"

namespace leafhull {

/// The leaves but for strays: the few that lie far from the rest.
struct Crown {
  Box box;                 ///< of the vertices
  std::size_t strays = 0;  ///< leaves that are none of it
  double farthest = 0;     ///< the most that one of them is away from the box, along an axis
};

/// Tells strays from the crown. Along each axis the crown's core lies between the 10% and the 90%
/// quantile of the leaves, whose longest side is L. A leaf belongs to the crown where it comes
/// within L/2 of the core, or of a leaf of the crown; at 3/4 L it does not. All others are strays
/// if they are no more than a tenth of the leaves, else none is. A leaf counts once, however finely
/// it is tessellated. SPEC: 4. `leaves`: bounds set; in any order.
Crown find_crown(const LeafSet& leaves);

/// Says how many strays there are, and how far away.
std::string stray_warning(const Crown& crown);

}  // namespace leafhull
