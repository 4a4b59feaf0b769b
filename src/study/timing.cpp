// SPDX-License-Identifier: Apache-2.0
#include "study/timing.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "leafhull/error.h"
#include "study/study_plan.h"

namespace leafhull {
namespace {

// Which stages of `extract` are which steps of Figure 8. Two stages belong to no step: `metrics`,
// and `threshold`, N at the leaf vertices, which is not needed if T is given.
using Stages = std::span<const std::string_view>;
constexpr std::string_view kGridAndSurface[] = {  // steps 1, 6 and 7
    "hash", "field", "polygonise", "snap"};
constexpr std::string_view kControl[] = {  // steps 2 and 3 to 5
    "isotropic density", "control"};

double seconds_of(const Report& report, Stages stages) {
  double sum = 0;
  for (const std::string_view stage : stages) {
    const auto found = std::find_if(report.seconds.begin(), report.seconds.end(),
                                    [&](const StageTime& time) { return time.stage == stage; });
    if (found == report.seconds.end()) {
      throw Error(ErrorCode::internal, "extract has no stage " + std::string(stage));
    }
    sum += found->seconds;
  }
  return sum;
}

double median(std::array<double, kRuns> values) {
  static_assert(kRuns % 2 == 1);
  std::nth_element(values.begin(), values.begin() + kRuns / 2, values.end());
  return values[kRuns / 2];
}

}  // namespace

StudyTime table2_time(const LeafSet& leaves, const Reading& reading, int resolution,
                      Device& device) {
  const ReadingStudy plan = planned(reading);
  const auto report = [&](Method method) {
    const StudyRow& row = plan.table1[static_cast<std::size_t>(method)];
    return extract(leaves, options_of(row, reading, resolution), device).report;
  };
  StudyTime time{.resolution = resolution, .runs = kRuns};
  std::array<double, kRuns> previous, proposed, control;
  try {
    for (int run = 0; run < kRuns; ++run) {  // in turn, so that a disturbance affects both
      previous[run] = seconds_of(report(Method::isotropic), kGridAndSurface);
      const Report controlled = report(Method::controlled);
      control[run] = seconds_of(controlled, kControl);
      proposed[run] = seconds_of(controlled, kGridAndSurface) + control[run];
    }
  } catch (const Error& error) {
    if (error.code() != ErrorCode::empty) throw;
    time.empty = true;
    return time;
  }
  time.previous = median(previous);
  time.proposed = median(proposed);
  time.control = median(control);
  return time;
}

}  // namespace leafhull
