// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <set>
#include <string>
#include <string_view>

namespace leafhull::cli {

/// What a person sees on standard error while a verb runs.
class Console {
 public:
  Console(bool quiet, bool verbose);
  ~Console();

  void say(const std::string& line);     ///< unless quiet
  void detail(const std::string& line);  ///< where verbose
  void warn(const std::string& line);    ///< unless quiet; the same line once

  /// A bar with the stage and the time since the start, on a terminal only.
  void progress(std::string_view stage, double done);

 private:
  using Clock = std::chrono::steady_clock;

  bool quiet_, verbose_, bar_;
  Clock::time_point start_ = Clock::now(), drawn_{};
  std::string stage_;
  std::set<std::string> warnings_;
};

/// Wipes the bar. Async-signal-safe.
void clear_progress() noexcept;

/// Prints `leafhull: error: what. What to do.` as one line.
void print_error(std::string what, const std::string& remedy);

}  // namespace leafhull::cli
