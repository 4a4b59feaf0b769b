// SPDX-License-Identifier: Apache-2.0
#include "study/study_plan.h"

#include <algorithm>

#include "leafhull/error.h"
#include "leafhull/series.h"

namespace leafhull {
namespace {

StudyRow row_of(Method method) {
  StudyRow row;
  row.method = method;
  row.threshold = kThreshold;
  row.radius_max = kRadiusMax;
  row.flatness = kFlatness;
  return row;
}

/// CTRLED at the paper's three values and halfway between.
std::vector<StudyRow> figure(double StudyRow::*parameter, std::initializer_list<double> values) {
  std::vector<StudyRow> rows;
  for (const double value : values) {
    rows.push_back(row_of(Method::controlled));
    rows.back().*parameter = value;
  }
  return rows;
}

bool same_setting(const StudyRow& a, const StudyRow& b) {
  return a.method == b.method && a.threshold == b.threshold && a.radius_max == b.radius_max &&
         a.flatness == b.flatness;
}

}  // namespace

std::string_view paper_name(Method method) {
  constexpr std::string_view kNames[] = {"L&D", "UNCTRLED", "CTRLED"};
  return kNames[static_cast<std::size_t>(method)];
}

std::array<Reading, 8> readings() {
  std::array<Reading, 8> all;
  auto next = all.begin();
  for (const int falloff : {2, 1}) {
    for (const Spread spread : {Spread::stddev, Spread::variance}) {
      for (const DensitySource density : {DensitySource::exact, DensitySource::grid}) {
        *next++ = {falloff, spread, density};
      }
    }
  }
  return all;
}

ReadingStudy planned(const Reading& reading) {
  ReadingStudy study;
  study.reading = reading;
  for (std::size_t i = 0; i < study.table1.size(); ++i) {
    study.table1[i] = row_of(static_cast<Method>(i));
  }
  study.figure11 = figure(&StudyRow::threshold, {1.5, 1.75, 2, 2.25, 2.5});
  study.figure13 = figure(&StudyRow::radius_max, {1.4, 1.45, 1.5, 1.55, 1.6});
  study.figure15 = figure(&StudyRow::flatness, {0.6, 0.65, 0.7, 0.75, 0.8});
  return study;
}

Options options_of(const StudyRow& row, const Reading& reading, int resolution) {
  Options options;
  options.method = row.method;
  options.threshold = row.threshold;
  options.radius_max = row.radius_max;
  options.flatness = row.flatness;
  options.points = PointSource::vertices;
  options.min_component = 0;
  options.hollows = Hollows::keep;
  options.falloff = reading.falloff;
  options.spread = reading.spread;
  options.density = reading.density;
  options.resolution = resolution;
  return options;
}

Plan plan(std::span<ReadingStudy> studies) {
  Plan plan;
  for (ReadingStudy& study : studies) {
    const std::size_t first = plan.rows.size();
    const auto add = [&](StudyRow& row) {
      const auto shared =
          std::find_if(plan.rows.begin() + static_cast<std::ptrdiff_t>(first), plan.rows.end(),
                       [&](const auto& rows) { return same_setting(*rows.front(), row); });
      if (shared != plan.rows.end()) return shared->push_back(&row);
      plan.options.push_back(options_of(row, study.reading));
      plan.rows.push_back({&row});
    };
    for (StudyRow& row : study.table1) add(row);
    for (auto* figure : {&study.figure11, &study.figure13, &study.figure15}) {
      for (StudyRow& row : *figure) add(row);
    }
  }
  return plan;
}

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
