// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace leafhull {

/// One line of a panel; a value that is not finite is a gap.
struct ChartLine {
  std::string name;
  std::vector<double> x, y;  ///< of equal length, x ascending
};

/// Lines over one vertical axis, which starts at zero.
struct ChartPanel {
  std::string y_label;
  std::vector<ChartLine> lines;
};

/// Panels side by side over the same horizontal axis; lines of one name look the same in all.
struct Chart {
  std::string title, x_label;
  std::vector<ChartPanel> panels;
};

/// Whether gnuplot, which draws charts, is installed.
bool can_draw_charts();

/// The chart as an SVG file: the same bytes for the same chart.
/// @throws Error output: gnuplot is missing or fails.
std::string svg(const Chart& chart);

}  // namespace leafhull
