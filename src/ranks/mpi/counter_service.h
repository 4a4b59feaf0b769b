// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mpi.h>

#include <cstdint>
#include <optional>
#include <stop_token>
#include <thread>

#include "ranks/mpi/host_board.h"
#include "ranks/mpi/session.h"

namespace leafhull {

/// Lets ranks of other hosts reach the counters on rank 0's board while rank 0 computes: a thread
/// of rank 0 looks for their messages every millisecond.
///
/// MPI_Fetch_and_op does not serve: over TCP Open MPI 4.1 has no window by default
/// (MPI_Win_allocate fails), and with osc/pt2pt or osc/ucx others wait until rank 0 calls MPI (2 s
/// in 2 s).
class CounterService {
 public:
  CounterService(Session& session, HostBoard& board);  ///< Collective, as is the destructor.
  ~CounterService();
  CounterService(const CounterService&) = delete;
  CounterService& operator=(const CounterService&) = delete;

  void errors_return();

  /// As HostBoard::add, on rank 0's board.
  std::uint64_t add(Counter counter, std::uint64_t amount);

 private:
  void serve(const std::stop_token& stop);
  bool answer_one();

  Session& session_;
  HostBoard& board_;
  MPI_Comm requests_ = MPI_COMM_NULL;
  std::optional<std::jthread> server_;  ///< on rank 0 only
};

}  // namespace leafhull
