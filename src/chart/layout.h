// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "chart/chart.h"
#include "chart/ticks.h"

namespace leafhull {

// Lengths are in pixels. The type is large because a phone shows a chart at about half its size.
inline constexpr double kChartWidth = 640;
inline constexpr double kTitleSize = 18, kLabelSize = 16, kTickSize = 15;
inline constexpr double kSampleLength = 40, kSampleGap = 8;  ///< in the legend, before a name

/// A text on its baseline.
struct ChartText {
  std::string text;
  double x = 0, y = 0, size = kLabelSize;
  bool centred = false;
};

/// The rectangle of a panel's lines, and what stands around it.
struct PanelLayout {
  double left = 0, right = 0, top = 0, bottom = 0;
  Axis x, y;
  ChartText heading, foot;
};

/// The positions of a chart's title, legend in rows and panels, from the top left.
struct ChartLayout {
  double height = 0;
  ChartText title;
  std::vector<ChartText> legend;  ///< a line's sample ends before its name
  std::vector<PanelLayout> panels;
};

/// An estimate, as the reader's typeface is unknown.
double text_width(std::string_view label, double size);

/// @param names of the legend
ChartLayout lay_out(const Chart& chart, const std::vector<std::string>& names);

}  // namespace leafhull
