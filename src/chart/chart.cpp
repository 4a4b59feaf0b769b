// SPDX-License-Identifier: Apache-2.0
#include "chart/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string_view>

#include "chart/gnuplot.h"
#include "chart/ticks.h"
#include "leafhull/error.h"
#include "text/text.h"

namespace leafhull {
namespace {

// Pixels of a chart that is as wide as kWidth. On a telephone it is half as wide: hence large type.
constexpr double kWidth = 640, kPanelHeight = 210, kMargin = 10, kGap = 28;
constexpr double kTitleSize = 18, kLabelSize = 16, kTickSize = 15;
constexpr double kTitleHeight = 36, kLegendRow = 24, kHeadingHeight = 44, kFootHeight = 62;
constexpr double kCharacter = 0.56;   // of the type's size: its mean width
constexpr double kSampleLength = 40;  // of a line in the legend
constexpr int kMarkers = 10;          // on a line of many points, about
constexpr std::string_view kFonts = "'Open Sans', 'Segoe UI', Helvetica, Arial, sans-serif";

/// How the lines of one name look. Colours of Okabe and Ito, neighbours far apart in lightness;
/// their yellow is too pale on white.
struct Look {
  std::string_view color;
  int point;
  std::string_view dash;
};
constexpr std::array<std::string_view, 7> kColors{"#0072B2", "#E69F00", "#000000", "#56B4E9",
                                                  "#D55E00", "#009E73", "#CC79A7"};
constexpr std::array<int, 6> kPoints{7, 5, 9, 13, 11, 15};
constexpr std::array<std::string_view, 5> kDashes{"solid", "(12,4)", "(4,3)", "(12,3,3,3)",
                                                  "(7,3)"};

Look look_of(std::size_t index) {
  return {kColors[index % kColors.size()], kPoints[index % kPoints.size()],
          kDashes[index % kDashes.size()]};
}

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// A text for gnuplot, subscripts and all.
std::string quoted(std::string_view label) {
  std::string text = "'";
  for (const TextRun& run : split_subscripts(label)) {
    if (run.subscript) text += "_{";
    for (const char32_t c : run.text) {
      if (std::u32string_view(U"\\^_@&~{}").find(c) != std::u32string_view::npos) text += '\\';
      if (c == U'\'') text += '\'';
      append_utf8(c, text);
    }
    if (run.subscript) text += '}';
  }
  return text + '\'';
}

double text_width(std::string_view label, double size) {
  return static_cast<double>(decode_utf8(label).size()) * kCharacter * size;
}

/// Composes the script of one chart; lengths are pixels from the top left.
class Script {
 public:
  explicit Script(const Chart& chart) : chart_(chart) {
    for (const ChartPanel& panel : chart.panels) {
      for (const ChartLine& line : panel.lines) {
        if (!looks_.contains(line.name)) {
          names_.push_back(line.name);
          looks_.emplace(line.name, look_of(looks_.size()));
        }
      }
    }
    std::erase(names_, "");
    arrange_legend();
    height_ = legend_top() + kLegendRow * rows_ + kHeadingHeight + kPanelHeight + kFootHeight;
  }

  std::string text() {
    add("set encoding utf8");
    add("set terminal svg enhanced dynamic size " + number(kWidth) + ',' + number(height_) +
        " font 'sans-serif," + number(kLabelSize) + "' rounded");
    add("set multiplot");
    add("unset key; unset border; set tics nomirror scale 0");
    if (!chart_.title.empty()) {
      label(chart_.title, kMargin, kMargin + kTitleSize, kTitleSize, "#111111", "left");
    }
    for (std::size_t i = 0; i < names_.size(); ++i) add_legend(i);
    for (std::size_t i = 0; i < chart_.panels.size(); ++i) add_panel(i);
    if (chart_.panels.empty()) add("set xrange [0:1]; set yrange [0:1]; unset tics; plot NaN");
    return script_;
  }

 private:
  void add(std::string_view line) { (script_ += line) += '\n'; }

  std::string at(double x, double y) const {
    return " screen " + number(x / kWidth) + ", screen " + number(1 - y / height_);
  }

  void label(std::string_view text, double x, double baseline, double size, std::string_view color,
             std::string_view align) {
    add("set label " + quoted(text) + " at" + at(x, baseline - 0.3 * size) + ' ' +
        std::string(align) + " font '," + number(size) + "' tc rgb '" + std::string(color) + '\'');
  }

  /// As many columns as fit, each as wide as its longest name.
  void arrange_legend() {
    for (std::size_t count = names_.size(); count > 0; --count) {
      columns_.assign(count + 1, kMargin);
      for (std::size_t column = 0; column < count; ++column) {
        double widest = 0;
        for (std::size_t i = column; i < names_.size(); i += count) {
          widest = std::max(widest, text_width(names_[i], kLabelSize));
        }
        columns_[column + 1] = columns_[column] + kSampleLength + 8 + widest + kGap;
      }
      rows_ = static_cast<int>((names_.size() + count - 1) / count);
      if (columns_.back() - kGap <= kWidth - kMargin) return;
    }
  }

  double legend_top() const { return kMargin + (chart_.title.empty() ? 0 : kTitleHeight); }

  void add_legend(std::size_t i) {
    const Look look = looks_.at(names_[i]);
    const std::size_t count = columns_.size() - 1;
    const double x = columns_[i % count];
    const double y = legend_top() + kLegendRow * (static_cast<double>(i / count) + 0.5);
    add("set arrow from" + at(x, y) + " to" + at(x + kSampleLength, y) + " nohead " + stroke(look));
    add("set label '' at" + at(x + kSampleLength / 2, y) + " point " + marker(look));
    label(names_[i], x + kSampleLength + 8, y + 0.3 * kLabelSize, kLabelSize, "#222222", "left");
  }

  static std::string stroke(const Look& look) {
    return "lw 2 lc rgb '" + std::string(look.color) + "' dt " + std::string(look.dash);
  }
  static std::string marker(const Look& look) {
    return "pt " + std::to_string(look.point) + " ps 0.75 lc rgb '" + std::string(look.color) +
           '\'';
  }

  void add_panel(std::size_t index) {
    const ChartPanel& panel = chart_.panels[index];
    std::vector<double> values, parameters;
    for (const ChartLine& line : panel.lines)
      values.insert(values.end(), line.y.begin(), line.y.end());
    for (const ChartPanel& other : chart_.panels) {
      for (const ChartLine& line : other.lines) {
        parameters.insert(parameters.end(), line.x.begin(), line.x.end());
      }
    }
    const Axis y = value_axis(values);
    double widest = 0;
    for (const Tick& tick : y.ticks) widest = std::max(widest, text_width(tick.text, kTickSize));

    const double count = static_cast<double>(chart_.panels.size());
    const double width = (kWidth - 2 * kMargin - (count - 1) * kGap) / count;
    const double panel_left = kMargin + static_cast<double>(index) * (width + kGap);
    const double left = panel_left + widest + 8, right = panel_left + width;
    const double top = legend_top() + kLegendRow * rows_ + kHeadingHeight;
    const double bottom = top + kPanelHeight;
    const Axis x = parameter_axis(parameters, (right - left) / (kTickSize * kCharacter));

    add("set lmargin at screen " + number(left / kWidth));
    add("set rmargin at screen " + number(right / kWidth));
    add("set tmargin at screen " + number(1 - top / height_));
    add("set bmargin at screen " + number(1 - bottom / height_));
    label(panel.y_label, panel_left, top - 18, kLabelSize, "#222222", "left");
    label(chart_.x_label, (left + right) / 2, bottom + 51, kLabelSize, "#222222", "center");
    add_axis('x', x);
    add_axis('y', y);
    add("set grid ytics lt 1 lw 1 lc rgb '#E2E2E2'");
    add("set arrow from graph 0, first 0 to graph 1, first 0 nohead lw 1 lc rgb '#808080' back");
    for (const Tick& tick : x.ticks) {
      add("set arrow from first " + number(tick.value) +
          ", graph 0 rto 0, graph -0.02 nohead lw 1 lc rgb '#808080'");
    }
    add_lines(panel);
    add("unset label; unset arrow");
  }

  void add_axis(char name, const Axis& axis) {
    std::string ticks;
    for (const Tick& tick : axis.ticks) {
      ticks += (ticks.empty() ? "" : ", ") + quoted(tick.text) + ' ' + number(tick.value);
    }
    add(std::string("set ") + name + "range [" + number(axis.low) + ':' + number(axis.high) + ']');
    add(std::string("set ") + name + "tics (" + ticks + ") font '," + number(kTickSize) +
        "' tc rgb '#444444'");
  }

  void add_lines(const ChartPanel& panel) {
    std::string plots;
    for (std::size_t i = 0; i < panel.lines.size(); ++i) {
      const ChartLine& line = panel.lines[i];
      const Look look = looks_.at(line.name);
      const std::string data = "$line" + std::to_string(i);
      add(data + " << end");
      add_points(line);
      add("end");
      const std::string title = " title " + quoted(line.name);
      plots += (plots.empty() ? "plot " : ", ") + data + " using 1:2 with lines " + stroke(look) +
               title + ", " + data + " using 1:3 with points " + marker(look) + title;
    }
    add(plots.empty() ? "plot NaN" : plots);
  }

  /// x, y, and y again where a marker stands: at every so many points, and at those alone between
  /// gaps.
  void add_points(const ChartLine& line) {
    const std::size_t count = std::min(line.x.size(), line.y.size());
    const auto there = [&](std::size_t i) {
      return i < count && std::isfinite(line.x[i]) && std::isfinite(line.y[i]);
    };
    const std::size_t every = 1 + count / (2 * kMarkers + 1) * 2;
    for (std::size_t i = 0; i < count; ++i) {
      const bool alone = !there(i - 1) && !there(i + 1);
      const std::string y = there(i) ? number(line.y[i]) : "NaN";
      const bool marked = i % every == 0 || alone || i + 1 == count;
      add((there(i) ? number(line.x[i]) : "0") + ' ' + y + ' ' + (marked ? y : "NaN"));
    }
    if (count == 0) add("0 NaN NaN");
  }

  const Chart& chart_;
  std::vector<std::string> names_;  ///< of the legend
  std::map<std::string, Look> looks_;
  int rows_ = 0;                 ///< of the legend
  std::vector<double> columns_;  ///< where they begin, and where the next one would
  double height_ = 0;
  std::string script_;
};

/// For a text in XML.
std::string escaped(std::string_view label) {
  std::string text;
  for (const char32_t c : decode_utf8(label)) {
    if (c == U'&') {
      text += "&amp;";
    } else if (c == U'<') {
      text += "&lt;";
    } else {
      append_utf8(c, text);
    }
  }
  return text;
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

bool can_draw_charts() {
  try {
    run_gnuplot("");
    return true;
  } catch (const Error&) {
    return false;
  }
}

std::string svg(const Chart& chart) {
  std::string file = run_gnuplot(Script(chart).text());
  replace_all(file, "<title>Gnuplot</title>", "<title>" + escaped(chart.title) + "</title>");
  replace_all(file, " font-family=\"sans-serif\"", "");
  replace_all(file, "<g id=\"gnuplot_canvas\">",
              "<g id=\"gnuplot_canvas\" font-family=\"" + std::string(kFonts) + "\">");
  return file;
}

}  // namespace leafhull
