// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "leaves/sheets.h"

namespace leafhull {

/// Places on leaves, and the sheets that they lie on.
struct Samples {
  std::vector<Vec3d> places;
  std::vector<std::uint32_t> sheet;
};

/// Places on the visible area of the leaves in `crown`, each standing for an equal share of it:
/// strays are not to move T.
Samples samples_of(const LeafSet::Sheets& sheets, const Box& crown);

}  // namespace leafhull
