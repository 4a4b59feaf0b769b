// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mpi.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "ranks/host.h"

namespace leafhull {

/// What the ranks add up: the sums, and the counter of Ranks::next.
enum class Counter : std::size_t { next = kSums };
inline constexpr std::size_t kCounters = kSums + 1;
inline Counter counter_of(Sum sum) { return static_cast<Counter>(sum); }

/// What the ranks of one host tell each other in shared memory, where a signal handler can read it
/// too.
class HostBoard {
 public:
  HostBoard();  ///< Collective, as is the destructor.
  ~HostBoard();
  HostBoard(const HostBoard&) = delete;
  HostBoard& operator=(const HostBoard&) = delete;

  int ranks() const { return static_cast<int>(pids_.size()); }
  int cores() const { return cores_; }  ///< that these ranks may use together

  bool has(int rank) const;  ///< `rank` is numbered among all ranks

  /// Adds the amount and returns the new sum.
  std::uint64_t add(Counter counter, std::uint64_t amount) noexcept;
  void set(Counter counter, std::uint64_t value) noexcept;
  void note(Counter counter, std::uint64_t value) noexcept;  ///< keeps a higher value
  std::uint64_t get(Counter counter) const noexcept;

  bool leave() noexcept;  ///< true for the first to leave
  void wait_for_leavers() const noexcept;
  bool is_lost(int rank) const noexcept;  ///< false for one of another host

 private:
  struct Board {
    std::atomic<int> left_ranks;
    std::array<std::atomic<std::uint64_t>, kCounters> counters;
  };
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

  std::atomic<std::uint64_t>& at(Counter counter) const noexcept {
    return board_->counters[static_cast<std::size_t>(counter)];
  }

  MPI_Comm host_ = MPI_COMM_NULL;
  MPI_Win window_ = MPI_WIN_NULL;
  Board* board_ = nullptr;
  std::atomic<bool>* left_ = nullptr;  ///< one per rank, behind the board
  int place_ = 0;                      ///< this rank's place on the board
  int cores_ = 1;
  std::vector<int> pids_;    ///< 0: a process that cannot be seen from here
  std::vector<int> places_;  ///< by rank among all; -1: on another host
};

}  // namespace leafhull
