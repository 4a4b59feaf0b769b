// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mpi.h>

#include <mutex>
#include <string_view>

namespace leafhull {

/// MPI from start to end. Until errors_return() an error of MPI ends all ranks.
class Session {
 public:
  /// @param launched how many processes should find each other, 2 or more.
  /// @throws Error usage: they do not.
  explicit Session(int launched);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  void errors_return();

  /// Held around every call of MPI where more than one thread of a rank makes them.
  std::mutex turn;

 private:
  int rank_ = 0, size_ = 0;
};

/// @throws Error internal: `result`, what `what` returned, is an error.
void check(int result, std::string_view what);

/// Waits until `request` is done and leaves the core to others meanwhile, which MPI_Wait would not.
void wait(MPI_Request request, std::mutex& turn);

}  // namespace leafhull
