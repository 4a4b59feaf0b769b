// SPDX-License-Identifier: Apache-2.0
#include "study/measure_plan.h"

#include <utility>

#include "leafhull/error.h"
#include "leafhull/series.h"

namespace leafhull {

void measure(const Plan& plan, const LeafSet& leaves, Device& device,
             const std::function<void(const Report&)>& each) {
  extract_series(leaves, plan.options, device, [&](std::size_t i, SeriesEntry&& entry) {
    if (!entry.failure.empty()) throw Error(ErrorCode::usage, entry.failure);
    for (StudyRow* row : plan.rows[i]) {
      row->empty = entry.empty();
      row->metrics = entry.report.metrics;
    }
    each(entry.report);
    return true;
  });
}

}  // namespace leafhull
