// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "leafhull/progress.h"
#include "leafhull/shape.h"

namespace leafhull {

/// Times the stages of an extraction and tells the caller which one runs.
class Stopwatch {
 public:
  explicit Stopwatch(const Progress& progress) : progress_(progress) {}

  /// Ends the running stage and starts the next.
  void start(std::string_view stage) {
    stop();
    stage_ = stage;
    began_ = Clock::now();
    advance(0);
  }

  /// Tells how far the running stage is, 0 to 1.
  void advance(double done) const {
    if (progress_) progress_({.stage = stage_, .done = done});
  }

  /// Ends the running stage. Returns the times since the last call by stage, the total last.
  std::vector<StageTime> finish() {
    stop();
    double total = 0;
    for (const StageTime& s : times_) total += s.seconds;
    times_.push_back({"total", total});
    return std::exchange(times_, {});
  }

 private:
  using Clock = std::chrono::steady_clock;

  void stop() {
    if (stage_.empty()) return;
    const double seconds = std::chrono::duration<double>(Clock::now() - began_).count();
    const auto same = [&](const StageTime& s) { return s.stage == stage_; };
    const auto row = std::find_if(times_.begin(), times_.end(), same);
    if (row == times_.end()) {
      times_.push_back({stage_, seconds});
    } else {
      row->seconds += seconds;
    }
    stage_.clear();
  }

  const Progress& progress_;
  std::string stage_;
  Clock::time_point began_;
  std::vector<StageTime> times_;
};

}  // namespace leafhull
