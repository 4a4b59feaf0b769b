// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace leafhull {

/// The processes that share a run. Collective calls are made by all of them in the same order.
class Ranks {
 public:
  virtual ~Ranks() = default;

  virtual int rank() const = 0;  ///< from 0
  virtual int size() const = 0;
  /// The next number of a counter that all ranks share, 0 first.
  virtual std::uint64_t next() = 0;
  /// Sets the shared counter to 0. Collective.
  virtual void reset() = 0;
  /// What every rank says, by rank. Collective.
  virtual std::vector<std::string> all(const std::string& mine) = 0;
  /// Waits for all. Collective.
  virtual void barrier() = 0;
  /// Ends every rank, this one with an exit code, after an error that the others do not know of.
  [[noreturn]] virtual void abort(int exit_code) = 0;
};

/// One process on its own.
std::unique_ptr<Ranks> single_rank();

/// The ranks of mpirun, or one where the process was not started by it.
/// @throws Error usage: started by mpirun, and built without MPI.
std::unique_ptr<Ranks> open_ranks();

}  // namespace leafhull
