// SPDX-License-Identifier: Apache-2.0
#include "cli/console.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iostream>

#include "cli/values.h"

namespace leafhull::cli {
namespace {

constexpr int kBarWidth = 30;
constexpr std::chrono::milliseconds kRedraw{50};
std::atomic<bool> shown = false;
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace

Console::Console(bool quiet, bool verbose)
    : quiet_(quiet), verbose_(verbose), bar_(!quiet && isatty(STDERR_FILENO) == 1) {}

Console::~Console() { clear_progress(); }

void Console::say(const std::string& line) {
  if (quiet_) return;
  clear_progress();
  std::cerr << line << '\n';
}

void Console::detail(const std::string& line) {
  if (verbose_) say(line);
}

void Console::warn(const std::string& line) {
  if (warnings_.insert(line).second) say("leafhull: warning: " + line);
}

void Console::progress(std::string_view stage, double done) {
  if (!bar_) return;
  const auto now = Clock::now();
  if (stage == stage_ && now - drawn_ < kRedraw) return;
  stage_ = stage;
  drawn_ = now;
  const int filled = static_cast<int>(std::lround(std::clamp(done, 0.0, 1.0) * kBarWidth));
  std::string name = stage_;
  name.resize(std::max<std::size_t>(name.size(), 10), ' ');
  shown = true;
  std::cerr << "\r\033[K" << name << " [" << std::string(filled, '#')
            << std::string(kBarWidth - filled, '.') << "] "
            << seconds(std::chrono::duration<double>(now - start_).count()) << std::flush;
}

void clear_progress() noexcept {
  constexpr std::string_view kWipe = "\r\033[K";
  if (!shown.exchange(false)) return;
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kWipe.data(), kWipe.size());
}

void print_error(std::string what, const std::string& remedy) {
  clear_progress();
  while (what.ends_with('.') || what.ends_with('\n')) what.pop_back();
  std::cerr << "leafhull: error: " << what << '.' << (remedy.empty() ? "" : " ") << remedy << '\n';
}

}  // namespace leafhull::cli
