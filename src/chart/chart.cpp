// SPDX-License-Identifier: Apache-2.0
#include "chart/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <system_error>

#include "chart/layout.h"
#include "leafhull/error.h"
#include "process/memory_file.h"
#include "process/process.h"
#include "text/choice.h"
#include "text/numbers.h"
#include "text/text.h"

namespace leafhull {
namespace {

constexpr std::size_t kIntervals = 10;     // between the markers of a line with many points
constexpr std::size_t kMarkedPoints = 21;  // up to this many, every point has a marker
constexpr std::string_view kFonts = "'Open Sans', 'Segoe UI', Helvetica, Arial, sans-serif";

/// How the lines of one name look. The colours are Okabe and Ito's, ordered so that neighbours
/// differ in lightness, without their yellow, which is too pale on white.
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

/// A quoted text for gnuplot, with subscripts.
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

/// A quoted text without subscripts, for gnuplot's `noenhanced`.
std::string quoted_plain(std::string_view label) {
  std::string text = "'";
  for (const char32_t c : decode_utf8(label)) {
    if (c == U'\'') text += '\'';
    append_utf8(c, text);
  }
  return text + '\'';
}

/// Composes gnuplot's script for one chart.
class Script {
 public:
  explicit Script(const Chart& chart) : chart_(chart) {
    std::vector<std::string> names;
    for (const ChartPanel& panel : chart.panels) {
      for (const ChartLine& line : panel.lines) {
        const bool is_new = looks_.try_emplace(line.name, look_of(looks_.size())).second;
        if (is_new && !line.name.empty()) names.push_back(line.name);
      }
    }
    layout_ = lay_out(chart, names);
  }

  std::string text() {
    add("set encoding utf8");
    add("set terminal svg enhanced dynamic rounded size " + shortest(kChartWidth) + ',' +
        shortest(layout_.height) + " font 'sans-serif," + shortest(kLabelSize) + '\'');
    add("set multiplot");
    add("unset key; unset border; set tics nomirror scale 0");
    add("set grid ytics lt 1 lw 1 lc rgb '#E2E2E2'");
    add_label(layout_.title);
    for (const ChartText& name : layout_.legend) add_legend(name);
    for (std::size_t i = 0; i < chart_.panels.size(); ++i) {
      add_frame(layout_.panels[i]);
      add_lines(chart_.panels[i]);
      add("unset label; unset arrow");
    }
    if (chart_.panels.empty()) add("set xrange [0:1]; set yrange [0:1]; unset tics; plot NaN");
    return script_;
  }

 private:
  void add(std::string_view line) { (script_ += line) += '\n'; }

  std::string at(double x, double y) const {
    return " screen " + across(x) + ", screen " + up(y) + ' ';
  }
  static std::string across(double x) { return shortest(x / kChartWidth); }
  std::string up(double y) const { return shortest(1 - y / layout_.height); }

  void add_label(const ChartText& label) {
    if (label.text.empty()) return;
    add("set label " + quoted(label.text) + " at" + at(label.x, label.y - 0.3 * label.size) +
        (label.centred ? "center" : "left") + " tc rgb '#222222' font '," + shortest(label.size) +
        '\'');
  }

  void add_legend(const ChartText& name) {
    const Look look = looks_.at(name.text);
    const double right = name.x - kSampleGap, left = right - kSampleLength,
                 y = name.y - 0.35 * kLabelSize;
    add("set arrow from" + at(left, y) + "to" + at(right, y) + "nohead " + stroke(look));
    add("set label '' at" + at((left + right) / 2, y) + "point " + marker(look));
    add_label(name);
  }

  static std::string color(const Look& look) { return "lc rgb '" + std::string(look.color) + '\''; }
  static std::string stroke(const Look& look) {
    return color(look) + " lw 2 dt " + std::string(look.dash);
  }
  static std::string marker(const Look& look) {
    return color(look) + " ps 0.75 pt " + std::to_string(look.point);
  }

  void add_frame(const PanelLayout& panel) {
    add("set lmargin at screen " + across(panel.left));
    add("set rmargin at screen " + across(panel.right));
    add("set tmargin at screen " + up(panel.top));
    add("set bmargin at screen " + up(panel.bottom));
    add_label(panel.heading);
    add_label(panel.foot);
    add_axis("x", panel.x);
    add_axis("y", panel.y);
    const std::string rule = " nohead lw 1 lc rgb '#808080' back";
    add("set arrow from graph 0, first 0 to graph 1, first 0" + rule);
    for (const Tick& tick : panel.x.ticks) {
      add("set arrow from first " + shortest(tick.value) + ", graph 0 rto 0, graph -0.02" + rule);
    }
  }

  void add_axis(const std::string& name, const Axis& axis) {
    const std::string ticks = joined(axis.ticks, ", ", [](const Tick& tick) {
      return quoted(tick.text) + ' ' + shortest(tick.value);
    });
    add("set " + name + "range [" + shortest(axis.low) + ':' + shortest(axis.high) + ']');
    add("set " + name + "tics (" + ticks + ") tc rgb '#444444' font '," + shortest(kTickSize) +
        '\'');
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
      const std::string title = " title " + quoted_plain(line.name) + " noenhanced";
      plots += plots.empty() ? "plot " : ", ";
      plots.append(data).append(" using 1:2 with lines ").append(stroke(look)).append(title);
      plots.append(", ").append(data).append(" using 1:3 with points ");
      plots.append(marker(look)).append(title);
    }
    add(plots.empty() ? "plot NaN" : plots);
  }

  /// Adds x, y, and y again if the point has a marker: isolated points do, and all or some others.
  void add_points(const ChartLine& line) {
    const std::size_t count = std::min(line.x.size(), line.y.size());
    const auto there = [&](std::size_t i) {
      return i < count && std::isfinite(line.x[i]) && std::isfinite(line.y[i]);
    };
    const auto interval = [&](std::size_t i) { return i * kIntervals / (count - 1); };
    for (std::size_t i = 0; i < count; ++i) {
      if (!there(i)) {
        add("0 NaN NaN");
        continue;
      }
      const bool alone = !there(i - 1) && !there(i + 1);
      const bool marked =
          count <= kMarkedPoints || alone || i == 0 || interval(i) > interval(i - 1);
      const std::string y = shortest(line.y[i]);
      add(shortest(line.x[i]) + ' ' + y + ' ' + (marked ? y : "NaN"));
    }
    if (count == 0) add("0 NaN NaN");
  }

  const Chart& chart_;
  std::map<std::string, Look> looks_;
  ChartLayout layout_;
  std::string script_;
};

/// A label escaped for XML.
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

[[noreturn]] void fail(const std::string& reason, const std::string& remedy = {}) {
  throw Error(ErrorCode::output, "charts cannot be drawn: " + reason, remedy);
}

void start_and_wait(const MemoryFile& input, const MemoryFile& output, const MemoryFile& messages) {
  const auto start = [&]() -> Process {
    try {
      return Process({"gnuplot", "-d"},
                     {input.descriptor(), output.descriptor(), messages.descriptor()});
    } catch (const std::system_error& error) {
      fail("gnuplot does not start (" + error.code().message() + ")",
           "Install gnuplot 5 on the PATH; on Debian: apt-get install gnuplot-nox");
    }
  };
  if (!start().wait()) fail("gnuplot says" + one_line(' ' + messages.read()));
}

/// The output of gnuplot for a script. Gnuplot ignores the user's settings and locale.
/// @throws Error output: gnuplot is missing, or says why it fails.
std::string run_gnuplot(const std::string& script) try {
  const MemoryFile input, output, messages;
  input.write(script);
  start_and_wait(input, output, messages);
  return output.read();
} catch (const std::system_error& error) {
  fail(error.code().message());
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
