// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include "leafhull/ranks.h"

namespace leafhull {

inline constexpr std::size_t kSums = 2;  ///< values of Sum

/// This process.
RankProcess this_process();

/// The ranks of MPI_COMM_WORLD, `launched` of them.
std::unique_ptr<Ranks> mpi_ranks(int launched);

}  // namespace leafhull
