// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "leafhull/leaves.h"

namespace leafhull {

/// The leaves without strays, the few that lie far from the rest.
struct Crown {
  Box box;                 ///< of the vertices
  std::size_t strays = 0;  ///< leaves outside the crown
  double farthest = 0;     ///< the largest distance of a stray from the box along an axis
};

/// Separates strays from the crown. Along each axis the crown's core lies between the 10% and the
/// 90% quantile of the leaves; its longest side is L. A leaf belongs to the crown if it comes
/// within L/2 of the core or of a leaf of the crown; at 3/4 L it does not. All others are strays if
/// they are at most a tenth of the leaves, else there are none. A leaf counts once, however finely
/// it is tessellated. SPEC: 4. `leaves` must have its bounds set; the order does not matter.
Crown find_crown(const LeafSet& leaves);

/// Says how many strays there are, and how far away.
std::string stray_warning(const Crown& crown);

}  // namespace leafhull
