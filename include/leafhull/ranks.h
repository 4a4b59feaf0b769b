// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "leafhull/api.h"

namespace leafhull {

/// What the ranks add up while they work.
enum class Sum {
  tiles,          ///< tiles on disk, including those from an earlier run
  leaf_vertices,  ///< leaf vertices in this run's tiles
};

/// A rank as its host knows it.
struct RankProcess {
  std::string host;
  int pid = 0;
};

/// The processes that share a run. All of them make collective calls, in the same order. One thread
/// at a time may use it. A rank that cannot go on calls abort(), or the others would wait for it.
class LEAFHULL_API Ranks {
 public:
  virtual ~Ranks() = default;  ///< Collective.

  virtual int rank() const = 0;  ///< from 0
  virtual int size() const = 0;
  virtual const std::vector<RankProcess>& processes() const = 0;  ///< by rank
  /// This rank's share of the cores of its host, at least 1.
  virtual int cores() const = 0;

  /// The next number of a counter that all ranks share, 0 first. Waits for no other rank.
  virtual std::uint64_t next() = 0;
  /// Sets that counter to 0. Collective.
  virtual void reset() = 0;
  /// Adds to a sum that all ranks share, initially 0, and returns it. Waits for no other rank.
  virtual std::uint64_t add(Sum sum, std::uint64_t amount) = 0;

  /// Replaces each number by its sum over all ranks. Collective.
  virtual void sum(std::span<std::uint64_t> numbers) = 0;
  /// The strings that all ranks passed, by rank. Collective.
  virtual std::vector<std::string> all(const std::string& mine) = 0;
  /// Waits for all ranks without using a core. Collective.
  virtual void barrier() = 0;

  // The next four serve a rank that ends early, perhaps in a signal handler: they are
  // async-signal-safe.

  /// Announces that this rank ends. True for the first on its host, which must report why.
  virtual bool leave() noexcept = 0;
  /// Whether the rank ran on this host and its process died without leave(), as after kill -9.
  virtual bool is_lost(int rank) const noexcept = 0;
  /// What add() last returned to any rank of this host; on a single host, the sum itself.
  virtual std::uint64_t last(Sum sum) const noexcept = 0;

  /// Waits, half a second at most, until the other ranks of this host have left or are gone: when
  /// the first one ends, Open MPI's mpirun may kill (-9) the rest while they are leaving.
  virtual void leave_together() noexcept = 0;

  /// Ends every rank after an error the others do not know of; this one exits with `exit_code`.
  [[noreturn]] virtual void abort(int exit_code) = 0;
};

/// One process on its own.
LEAFHULL_API std::unique_ptr<Ranks> single_rank();

/// The ranks of mpirun or srun, or a single one if they did not start this process as one of
/// several.
/// @throws Error usage: started as one of several by mpirun, but built without MPI or with another
///         MPI than mpirun's.
LEAFHULL_API std::unique_ptr<Ranks> open_ranks();

}  // namespace leafhull
