// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "leafhull/ranks.h"

namespace leafhull {

/// The ranks of MPI_COMM_WORLD, `launched` of them.
std::unique_ptr<Ranks> mpi_ranks(int launched);

}  // namespace leafhull
