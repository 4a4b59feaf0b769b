// SPDX-License-Identifier: Apache-2.0
#include "sweep/plots.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>
#include <utility>

#include "sweep/sweep_plan.h"
#include "sweep/tables.h"
#include "text/choice.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

/// More than kMostLines lines are too many to tell apart; then at most kFewLines are drawn.
constexpr std::size_t kMostLines = 12, kFewLines = 6;

double number(std::string_view text) { return parsed<double>(text).value_or(0); }

std::string file_of(const SweptOption& option) {
  return "plot-" + std::string(option.row->name) + ".svg";
}

/// `count` of the values, the first and the last among them where there are two or more.
std::vector<std::string_view> some_of(const std::vector<std::string>& values, std::size_t count) {
  std::vector<std::string_view> some;
  for (std::size_t i = 0; i < count; ++i) {
    some.push_back(values[count == 1 ? 0 : i * (values.size() - 1) / (count - 1)]);
  }
  return some;
}

using Values = std::vector<std::vector<std::string_view>>;

/// The values of every option that are drawn: all of the one along the axis, and of the others all
/// or some.
Values drawn_values(const SweepPlan& plan, std::size_t axis) {
  std::vector<std::size_t> counts;
  for (const SweptOption& option : plan.swept()) counts.push_back(option.values.size());
  const std::size_t along = std::exchange(counts[axis], 1);
  const auto lines = [&] {
    return std::accumulate(counts.begin(), counts.end(), std::size_t{1}, std::multiplies<>());
  };
  // Leave out numbers before names: only numbers can be judged from those around them.
  const auto rank = [&](std::size_t i) {
    return std::pair(counts[i] > 2 && takes_number(*plan.swept()[i].row), counts[i]);
  };
  while (plan.combinations().size() / along > kMostLines && lines() > kFewLines) {
    std::size_t widest = 0;
    for (std::size_t i = 1; i < counts.size(); ++i) {
      if (rank(i) > rank(widest)) widest = i;
    }
    --counts[widest];
  }
  counts[axis] = along;
  Values values;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    values.push_back(some_of(plan.swept()[i].values, counts[i]));
  }
  return values;
}

bool is_drawn(const std::vector<std::string_view>& values, const Values& drawn) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::find(drawn[i].begin(), drawn[i].end(), values[i]) == drawn[i].end()) return false;
  }
  return true;
}

/// The values of all options but the one along the axis.
std::string line_name(const SweepPlan& plan, std::size_t axis, std::size_t combination) {
  std::vector<std::string> others = labels(plan, combination);
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(axis));
  return joined(others, ", ");
}

ChartLine& line_named(std::vector<ChartLine>& lines, const std::string& name) {
  const auto found =
      std::find_if(lines.begin(), lines.end(), [&](const auto& line) { return line.name == name; });
  return found != lines.end() ? *found : lines.emplace_back(ChartLine{name, {}, {}});
}

void sort_by_x(ChartLine& line) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < line.x.size(); ++i) points.emplace_back(line.x[i], line.y[i]);
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < points.size(); ++i) std::tie(line.x[i], line.y[i]) = points[i];
}

std::string axis_label(const SweepPlan& plan, const OptionRow& row) {
  std::string unit(row.unit);
  const bool units = std::any_of(plan.swept().begin(), plan.swept().end(),
                                 [](const auto& o) { return o.row->name == "radius-unit"; });
  if (row.name == "radius-max" && !units) {
    constexpr std::string_view kUnits[] = {"crown units", "mean leaf radii", "model units"};
    unit = kUnits[static_cast<std::size_t>(plan.combinations().front().radius_unit)];
  }
  return std::string(row.name) + (unit.empty() ? "" : " (" + unit + ")");
}

ChartPanel panel(const SweepPlan& plan, const std::map<std::size_t, Json>& rows, std::size_t axis,
                 const std::string& label, const char* metric) {
  const Values drawn = drawn_values(plan, axis);
  ChartPanel panel{label, {}};
  for (const auto& [combination, row] : rows) {
    const std::vector<std::string_view> values = values_of(plan, combination);
    if (!is_drawn(values, drawn)) continue;
    ChartLine& line = line_named(panel.lines, line_name(plan, axis, combination));
    line.x.push_back(number(values[axis]));
    line.y.push_back(failure_of(row).empty() ? row["metrics"][metric].get<double>() : NAN);
  }
  for (ChartLine& line : panel.lines) sort_by_x(line);
  return panel;
}

std::string title(const SweepPlan& plan, std::size_t axis, std::size_t lines,
                  std::string_view tree) {
  const std::size_t all = plan.combinations().size() / plan.swept()[axis].values.size();
  const std::string what =
      std::string(tree) + ": what " + std::string(plan.swept()[axis].row->name) + " changes";
  return lines == all
             ? what
             : what + " (" + std::to_string(lines) + " of " + std::to_string(all) + " lines drawn)";
}

Chart chart(const SweepPlan& plan, const std::map<std::size_t, Json>& rows, std::size_t axis,
            std::string_view tree) {
  Chart chart{{}, axis_label(plan, *plan.swept()[axis].row), {}};
  chart.panels = {panel(plan, rows, axis, "dilated voxels", "dilated_voxels"),
                  panel(plan, rows, axis, "off-site vertices (sampled)", "off_site_sampled")};
  chart.title = title(plan, axis, chart.panels.front().lines.size(), tree);
  return chart;
}

}  // namespace

std::vector<Plot> plots(const SweepPlan& plan, const std::map<std::size_t, Json>& rows,
                        std::string_view tree) {
  std::vector<Plot> plots;
  for (std::size_t axis = 0; axis < plan.swept().size(); ++axis) {
    if (!takes_number(*plan.swept()[axis].row)) continue;
    plots.push_back({file_of(plan.swept()[axis]), chart(plan, rows, axis, tree)});
  }
  return plots;
}

std::vector<std::string> plot_files(const SweepPlan& plan) {
  std::vector<std::string> files;
  for (const SweptOption& option : plan.swept()) {
    if (takes_number(*option.row)) files.push_back(file_of(option));
  }
  return files;
}

}  // namespace leafhull
