// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "leaves/sheets.h"

namespace leafhull {

/// Places on the visible area of the leaves, each standing for an equal share of it.
std::vector<Vec3d> samples_of(const LeafSheets& sheets);

}  // namespace leafhull
