// SPDX-License-Identifier: Apache-2.0
#include "chart/layout.h"

#include <algorithm>

#include "text/text.h"

namespace leafhull {
namespace {

constexpr double kMargin = 10, kGap = 28, kTickGap = 8;
constexpr double kTitleHeight = 36, kLegendRow = 24, kHeadingHeight = 44, kPanelHeight = 210,
                 kFootHeight = 62;
constexpr double kCharacter = 0.56;  // the mean width, as a share of the type's size

/// A text that is set smaller if it would be wider than `room`.
ChartText fitted(std::string_view text, double x, double y, double size, double room) {
  const double width = text_width(text, size);
  return {std::string(text), x, y, width > room ? size * room / width : size};
}

/// Names in as many columns as fit, each as wide as its longest.
std::vector<ChartText> lay_out_legend(const std::vector<std::string>& names, double top) {
  constexpr double kRoom = kChartWidth - 2 * kMargin - kSampleLength - kSampleGap;
  std::vector<ChartText> legend(names.size());
  for (std::size_t columns = names.size(); columns > 0; --columns) {
    double left = kMargin;
    for (std::size_t column = 0; column < columns; ++column) {
      left += kSampleLength + kSampleGap;
      double widest = 0;
      for (std::size_t i = column; i < names.size(); i += columns) {
        const std::size_t row = i / columns;
        const double middle = top + kLegendRow * (static_cast<double>(row) + 0.5);
        legend[i] = fitted(names[i], left, middle + 0.35 * kLabelSize, kLabelSize, kRoom);
        widest = std::max(widest, text_width(names[i], legend[i].size));
      }
      left += widest + kGap;
    }
    if (left - kGap <= kChartWidth - kMargin) break;
  }
  return legend;
}

PanelLayout lay_out_panel(const ChartPanel& panel, double left, double width, double top) {
  PanelLayout layout;
  std::vector<double> values;
  for (const ChartLine& line : panel.lines) {
    values.insert(values.end(), line.y.begin(), line.y.end());
  }
  layout.y = value_axis(values);
  double widest = 0;
  for (const Tick& tick : layout.y.ticks) {
    widest = std::max(widest, text_width(tick.text, kTickSize));
  }
  layout.left = left + widest + kTickGap, layout.right = left + width;
  layout.top = top + kHeadingHeight, layout.bottom = layout.top + kPanelHeight;
  layout.heading = fitted(panel.y_label, left, layout.top - 18, kLabelSize, width);
  return layout;
}

/// One axis for all panels, with as many marks as fit the narrowest.
Axis shared_axis(const Chart& chart, const std::vector<PanelLayout>& panels) {
  std::vector<double> values;
  double narrowest = kChartWidth;
  for (const PanelLayout& panel : panels) {
    narrowest = std::min(narrowest, panel.right - panel.left);
  }
  for (const ChartPanel& panel : chart.panels) {
    for (const ChartLine& line : panel.lines) {
      values.insert(values.end(), line.x.begin(), line.x.end());
    }
  }
  return parameter_axis(values, narrowest / (kTickSize * kCharacter));
}

}  // namespace

double text_width(std::string_view label, double size) {
  return static_cast<double>(decode_utf8(label).size()) * kCharacter * size;
}

ChartLayout lay_out(const Chart& chart, const std::vector<std::string>& names) {
  ChartLayout layout;
  double top = kMargin;
  if (!chart.title.empty()) {
    layout.title =
        fitted(chart.title, kMargin, top + kTitleSize, kTitleSize, kChartWidth - 2 * kMargin);
    top += kTitleHeight;
  }
  layout.legend = lay_out_legend(names, top);
  if (!names.empty()) top = layout.legend.back().y - 0.35 * kLabelSize + kLegendRow / 2;

  const double count = static_cast<double>(std::max<std::size_t>(chart.panels.size(), 1));
  const double width = (kChartWidth - 2 * kMargin - (count - 1) * kGap) / count;
  double left = kMargin;
  for (const ChartPanel& panel : chart.panels) {
    layout.panels.push_back(lay_out_panel(panel, left, width, top));
    left += width + kGap;
  }
  const Axis x = shared_axis(chart, layout.panels);
  for (PanelLayout& panel : layout.panels) {
    panel.x = x;
    panel.foot = fitted(chart.x_label, (panel.left + panel.right) / 2, panel.bottom + 51,
                        kLabelSize, panel.right - panel.left);
    panel.foot.centred = true;
  }
  layout.height = top + kHeadingHeight + kPanelHeight + kFootHeight;
  return layout;
}

}  // namespace leafhull
