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
  /// @throws Error usage: `quiet` and `verbose` together.
  Console(bool quiet, bool verbose);
  ~Console();

  void say(const std::string& line);     ///< unless quiet
  void detail(const std::string& line);  ///< where verbose
  void warn(const std::string& line);    ///< unless quiet; each line only once

  /// A bar with the stage and the time since the start, on a terminal only.
  void progress(std::string_view stage, double done);
  /// The same where `done` is the share of all the work, with the time left.
  void progress_of_all(std::string_view stage, double done);
  /// The same for a number of things: how many are done, and the time left at their pace. Things
  /// already done at the first call, or at the first after count_anew(), do not count for the pace.
  /// `facts` are shown beside them.
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
