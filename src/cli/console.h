// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace leafhull::cli {

/// What a person sees on standard error while a verb runs.
class Console {
 public:
  /// @throws Error usage: both.
  Console(bool quiet, bool verbose);
  ~Console();

  void say(const std::string& line);     ///< unless quiet
  void detail(const std::string& line);  ///< where verbose
  void warn(const std::string& line);    ///< unless quiet; the same line once

  /// A bar with the stage and the time since the start, on a terminal only.
  void progress(std::string_view stage, double done);
  /// The same where `done` is of all there is to do, with the time left.
  void progress_of_all(std::string_view stage, double done);
  /// The same for a row of things: how many are done, and from their pace the time left. What is
  /// done at the first call was not done now, nor at the first after count_anew(). `facts` stand
  /// beside them.
  void progress(std::string_view stage, std::size_t done, std::size_t all,
                const std::string& facts = {});
  void count_anew() { resumed_.reset(); }

 private:
  using Clock = std::chrono::steady_clock;

  void draw(std::string_view stage, double done, const std::string& beside);

  bool quiet_, verbose_, bar_;
  Clock::time_point start_ = Clock::now(), drawn_{};
  std::string stage_;
  std::optional<std::size_t> resumed_;
  Clock::time_point resumed_at_{};
  std::set<std::string> warnings_;
};

/// In seconds.
inline double since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Wipes the bar. Async-signal-safe.
void clear_progress() noexcept;

/// An exception as the command ends with it.
struct Failure {
  int exit_code = 0;
  std::string what, remedy;
};

/// The exception that is being handled.
Failure current_failure();

/// Prints `leafhull: error: what. What to do.` as one line.
void print_error(std::string what, const std::string& remedy);

}  // namespace leafhull::cli
