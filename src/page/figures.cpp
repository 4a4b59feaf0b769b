// SPDX-License-Identifier: Apache-2.0
#include "page/figures.h"

#include <cmath>
#include <span>

#include "chart/chart.h"

namespace leafhull {
namespace {

template <class Count>
ChartPanel panel(std::string label, const ParameterFigures& figures,
                 std::span<const ReadingStudy> readings, Count count) {
  ChartPanel panel{.y_label = std::move(label), .lines = {}};
  for (const ReadingStudy& reading : readings) {
    ChartLine line;
    if (readings.size() > 1) line.name = reading_name(reading.reading);
    for (const StudyRow& row : reading.*figures.rows) {
      line.x.push_back(row.*figures.value);
      line.y.push_back(row.empty ? std::nan("") : static_cast<double>(count(row)));
    }
    panel.lines.push_back(std::move(line));
  }
  return panel;
}

Chart chart(const ParameterFigures& figures, std::span<const ReadingStudy> readings) {
  return {.title = "",
          .x_label = std::string(figures.axis),
          .panels = {panel("dilated voxels", figures, readings,
                           [](const StudyRow& row) { return row.metrics.dilated_voxels; }),
                     panel("off-site vertices", figures, readings,
                           [](const StudyRow& row) { return row.off_site(); })}};
}

}  // namespace

const std::array<ParameterFigures, 3> kParameterFigures{
    {{11, 12, "T", "the threshold", "threshold T", &ReadingStudy::figure11, &StudyRow::threshold,
      &TreeStudy::figure12},
     {13, 14, "R_max", "the radius of sparse leaves", "radius R_max (crown units)",
      &ReadingStudy::figure13, &StudyRow::radius_max, &TreeStudy::figure14},
     {15, 16, "λ_R", "the flatness", "flatness λ_R", &ReadingStudy::figure15, &StudyRow::flatness,
      &TreeStudy::figure16}}};

std::string reading_name(const Reading& reading) {
  const std::string spread = reading.spread == Spread::stddev ? "standard deviation" : "variance";
  return "k = " + std::to_string(reading.falloff) + ", " + spread + ", " +
         std::string(name(reading.density)) + " density";
}

std::vector<TreePlots> draw_plots(const Study& study) {
  std::vector<TreePlots> plots;
  if (!can_draw_charts()) return plots;
  for (const TreeStudy& tree : study.trees) {
    TreePlots& of_tree = plots.emplace_back();
    for (std::size_t i = 0; i < kParameterFigures.size(); ++i) {
      const std::span readings(tree.readings);
      of_tree.first[i] = svg(chart(kParameterFigures[i], readings.first(1)));
      of_tree.all[i] = svg(chart(kParameterFigures[i], readings));
    }
  }
  return plots;
}

}  // namespace leafhull
