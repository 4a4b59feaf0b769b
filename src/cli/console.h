// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <set>
#include <string>

#include "leafhull/progress.h"

namespace leafhull::cli {

/// What a person sees on standard error while a verb runs.
class Console {
 public:
  /// @throws Error usage: `quiet` and `verbose` together.
  Console(bool quiet, bool verbose);
  ~Console();

  void say(const std::string& line);     ///< unless quiet
  void detail(const std::string& line);  ///< where verbose
  void warn(const std::string& line);    ///< unless quiet; each line only once

  /// A bar with the stage, what is counted, the time since the start and, where it can be told, the
  /// time left; on a terminal only. Things already finished at the first call, or at the first
  /// after count_anew(), do not count for their pace.
  void progress(const Advance& now);
  void count_anew() { resumed_.reset(); }

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<double> seconds_left(const Advance& now) const;
  void draw(const Advance& now);

  bool quiet_, verbose_, bar_;
  Clock::time_point start_ = Clock::now(), drawn_{};
  std::string stage_;
  std::optional<std::size_t> resumed_;
  Clock::time_point resumed_at_{};
  std::set<std::string> warnings_;
};

/// Seconds since `begin`.
inline double since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Wipes the bar. Async-signal-safe.
void clear_progress() noexcept;

/// An exception as the command reports it when it ends.
struct Failure {
  int exit_code = 0;
  std::string what, remedy;
};

/// The failure that the exception being handled stands for.
Failure current_failure();

/// Prints `leafhull: error: what. What to do.` as one line.
void print_error(std::string what, const std::string& remedy);

}  // namespace leafhull::cli
