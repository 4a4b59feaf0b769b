// SPDX-License-Identifier: Apache-2.0
#include "page/figures.h"

#include <cmath>
#include <span>
#include <utility>

#include "chart/chart.h"
#include "study/band_study.h"

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

/// Rows as points of the two ratios that can be compared between trees.
ChartLine line(std::string name, std::span<const StudyRow> rows, const StudyRow& isotropic,
               std::uint64_t leaf_vertices) {
  ChartLine line{std::move(name), {}, {}};
  for (const StudyRow& row : rows) {
    line.x.push_back(100 * share_lost(row, leaf_vertices));
    line.y.push_back(share_dilated(row, isotropic));
  }
  return line;
}

/// CTRLED on its way from L&D to UNCTRLED, together with the paper's CTRLED.
Chart chart(const BandStudy& band, std::uint64_t leaf_vertices) {
  std::vector<StudyRow> way{band.isotropic};
  for (const BandRow& row : band.by_share) way.push_back(row.row);
  way.push_back(band.uncontrolled);
  const std::span usual(&band.by_deviation.front().row, 1);
  const auto& paper = paper_results().table1;
  const std::span paper_controlled(&paper[static_cast<std::size_t>(Method::controlled)], 1);
  return {.title = "",
          .x_label = "off-site vertices (% of the leaf vertices)",
          .panels = {{.y_label = "dilated voxels, L&D = 1",
                      .lines = {line("CTRLED", way, band.isotropic, leaf_vertices),
                                line("band " + name(band.by_deviation.front().band), usual,
                                     band.isotropic, leaf_vertices),
                                line("the paper’s CTRLED", paper_controlled, paper.front(),
                                     kPaperLeafVertices)}}}};
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
    if (tree.band.failure.empty()) of_tree.band = svg(chart(tree.band, tree.leaf_vertices));
  }
  return plots;
}

}  // namespace leafhull
