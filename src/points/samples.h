// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "leaves/sheets.h"

namespace leafhull {

/// Places on the visible area of the leaves in `crown`, each standing for an equal share of it:
/// strays are not to move T.
std::vector<Vec3d> samples_of(const LeafSheets& sheets, const Box& crown);

}  // namespace leafhull
