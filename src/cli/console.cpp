// SPDX-License-Identifier: Apache-2.0
#include "cli/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iostream>
#include <new>
#include <string>

#include "cli/values.h"
#include "leafhull/error.h"

namespace leafhull::cli {
namespace {

constexpr int kBarWidth = 30, kLeastBarWidth = 5;
constexpr std::chrono::milliseconds kRedraw{50};
std::atomic<bool> shown = false;
static_assert(std::atomic<bool>::is_always_lock_free);

/// The width of the terminal that shows the bar.
int columns() {
  winsize size{};
  const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? size.ws_col : 100;
}

/// Whole seconds, or minutes, or hours and minutes.
std::string duration(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 100) return std::to_string(whole) + " s";
  const long minutes = std::lround(seconds / 60);
  if (minutes < 100) return std::to_string(minutes) + " min";
  return std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
}

/// Prints in one write, because the output of several ranks on one terminal mixes write by write.
void print(const std::string& text) { std::cerr << text << std::flush; }

}  // namespace

Console::Console(bool quiet, bool verbose)
    : quiet_(quiet), verbose_(verbose), bar_(!quiet && isatty(STDERR_FILENO) == 1) {
  if (quiet && verbose) {
    throw Error(ErrorCode::usage, "--quiet and --verbose contradict each other",
                "Give one of the two.");
  }
}

Console::~Console() { clear_progress(); }

void Console::say(const std::string& line) {
  if (quiet_) return;
  clear_progress();
  print(line + '\n');
}

void Console::detail(const std::string& line) {
  if (verbose_) say(line);
}

void Console::warn(const std::string& line) {
  if (warnings_.insert(line).second) say("leafhull: warning: " + line);
}

void Console::progress(const Advance& now) {
  // A tile or a combination passes its stages too fast to show each of them.
  const bool begins = now.all > 0 ? !resumed_ : stage_ != now.stage;
  if (now.all > 0 && begins) resumed_ = now.finished, resumed_at_ = Clock::now();
  if (bar_ && (begins || Clock::now() - drawn_ >= kRedraw)) draw(now);
}

std::optional<double> Console::seconds_left(const Advance& now) const {
  if (now.is_even && now.done > 0) return since(start_) * (1 - now.done) / now.done;
  if (now.all == 0 || now.finished <= *resumed_ || now.finished >= now.all) return std::nullopt;
  const double pace = since(resumed_at_) / static_cast<double>(now.finished - *resumed_);
  return pace * static_cast<double>(now.all - now.finished);
}

void Console::draw(const Advance& now) {
  const double gone = since(start_);
  double done = now.done;
  std::string beside;
  if (now.all > 0) {
    done = static_cast<double>(now.finished) / static_cast<double>(now.all);
    beside = std::to_string(now.finished) + " of " + std::to_string(now.all) + ", ";
    if (now.resident_bytes > 0) {
      beside += per_second(now.leaf_vertices, gone) + ", " + bytes(now.resident_bytes) + ", ";
    }
  }
  beside += seconds(gone);
  if (const auto left = seconds_left(now)) beside += ", about " + duration(*left) + " left";
  stage_ = now.stage;
  drawn_ = Clock::now();
  std::string name = stage_;
  name.resize(std::max<std::size_t>(name.size(), 10), ' ');
  const int room = columns() - static_cast<int>(name.size() + std::size(" [] ") + beside.size());
  const int width = std::clamp(room, kLeastBarWidth, kBarWidth);
  const int filled = static_cast<int>(std::lround(std::clamp(done, 0.0, 1.0) * width));
  shown = true;
  print("\r\033[K" + name + " [" + std::string(filled, '#') + std::string(width - filled, '.') +
        "] " + beside);
}

void clear_progress() noexcept {
  constexpr std::string_view kWipe = "\r\033[K";
  if (!shown.exchange(false)) return;
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kWipe.data(), kWipe.size());
}

Failure current_failure() {
  constexpr int kInternal = static_cast<int>(ErrorCode::internal);
  try {
    throw;
  } catch (const Error& error) {
    return {static_cast<int>(error.code()), error.what(), error.remedy()};
  } catch (const std::bad_alloc&) {
    return {kInternal, "out of memory", "Try a lower --resolution."};
  } catch (const std::exception& error) {
    return {kInternal, "internal error: " + std::string(error.what()),
            "Please report it with the command and the tree."};
  }
}

void print_error(std::string what, const std::string& remedy) {
  clear_progress();
  while (what.ends_with('.') || what.ends_with('\n')) what.pop_back();
  print("leafhull: error: " + what + '.' + (remedy.empty() ? "" : " ") + remedy + '\n');
}

}  // namespace leafhull::cli
