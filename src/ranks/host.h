// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "leafhull/ranks.h"

namespace leafhull {

inline constexpr std::size_t kSums = 2;  ///< values of Sum

/// This process.
RankProcess this_process();

}  // namespace leafhull
