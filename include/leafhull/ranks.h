// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace leafhull {

/// What the ranks add up while they work.
enum class Sum {
  tiles,          ///< that are on the disk, those from an earlier run included
  leaf_vertices,  ///< of this run's tiles
};

/// A rank as its host knows it.
struct RankProcess {
  std::string host;
  int pid = 0;
};

/// The processes that share a run. Collective calls are made by all of them in the same order. For
/// one thread at a time. A rank that cannot go on calls abort(): the others would wait for it.
class Ranks {
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
  /// Adds to a sum that all ranks share, 0 at first, and returns it. Waits for no other rank.
  virtual std::uint64_t add(Sum sum, std::uint64_t amount) = 0;

  /// Adds up what the ranks hold, number by number. Collective.
  virtual void sum(std::span<std::uint64_t> numbers) = 0;
  /// What every rank says, by rank. Collective.
  virtual std::vector<std::string> all(const std::string& mine) = 0;
  /// Waits for all, without taking a core. Collective.
  virtual void barrier() = 0;

  // For a rank that ends before its time, in a handler of a signal too: these four are
  // async-signal-safe.

  /// Says that this rank ends. True for the first on its host, which is the one to say why.
  virtual bool leave() noexcept = 0;
  /// Whether the rank is of this host and its process is gone without a word, as after kill -9.
  virtual bool is_lost(int rank) const noexcept = 0;
  /// What add() returned, to any rank of this host; on one host, the sum itself.
  virtual std::uint64_t last(Sum sum) const noexcept = 0;

  /// Waits until the other ranks of this host have left or are gone, half a second at most: where
  /// the first one ends, Open MPI's mpirun may kill (-9) the rest in the middle of their leaving.
  virtual void leave_together() noexcept = 0;

  /// Ends every rank, this one with an exit code, after an error that the others do not know of.
  [[noreturn]] virtual void abort(int exit_code) = 0;
};

/// One process on its own.
std::unique_ptr<Ranks> single_rank();

/// The ranks of mpirun or srun, or one where the process was not started by them as one of several.
/// @throws Error usage: started as one of several by mpirun, and built without MPI or with another
///         one than mpirun's.
std::unique_ptr<Ranks> open_ranks();

}  // namespace leafhull
