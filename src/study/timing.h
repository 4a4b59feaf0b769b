// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/study.h"

namespace leafhull {

inline constexpr int kRuns = 5;  ///< of each method; odd, for the median

/// A row of Table 2, from kRuns extractions of each method.
/// @throws Error as extract does, except for an empty surface.
StudyTime table2_time(const LeafSet& leaves, const Reading& reading, int resolution,
                      Device& device);

}  // namespace leafhull
