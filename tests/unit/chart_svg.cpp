// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <regex>
#include <string>

#include "chart/chart.h"
#include "chart/layout.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class ChartSvg : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_draw_charts()) GTEST_SKIP() << "gnuplot is not installed: no chart is tested";
  }
};

Chart chart_of(std::vector<ChartLine> lines) {
  return {"birch", "threshold T", {{"dilated voxels", std::move(lines)}}};
}

int count(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  return static_cast<int>(
      std::distance(std::sregex_iterator(text.begin(), text.end(), regex), std::sregex_iterator()));
}

/// The text that a reader sees: the <text> elements without their tags.
std::string visible(const std::string& svg) {
  std::string all;
  const std::regex element("<text>(.*?)</text>");
  for (std::sregex_iterator i(svg.begin(), svg.end(), element), end; i != end; ++i) {
    all += std::regex_replace((*i)[1].str(), std::regex("<[^>]*>"), "") + '\n';
  }
  return all;
}

/// Whether tags nest and every ampersand begins an entity.
bool is_well_formed(const std::string& svg) {
  static const std::regex token(R"(<\?[^>]*\?>|<!--[^]*?-->|<(/?)([A-Za-z:]+)[^<>]*?(/?)>|[<&])");
  static const std::regex entity("&(amp|lt|gt|quot|apos|#[0-9]+|#x[0-9a-fA-F]+);");
  std::vector<std::string> open;
  for (std::sregex_iterator i(svg.begin(), svg.end(), token), end; i != end; ++i) {
    const std::smatch& match = *i;
    if (match[0] == "<") return false;
    if (match[0] == "&") {
      const auto here = svg.begin() + match.position();
      if (!std::regex_search(here, svg.end(), entity, std::regex_constants::match_continuous)) {
        return false;
      }
    } else if (match[1].length() > 0) {
      if (open.empty() || open.back() != match[2]) return false;
      open.pop_back();
    } else if (match[2].length() > 0 && match[3].length() == 0) {
      open.push_back(match[2]);
    }
  }
  return open.empty();
}

TEST_F(ChartSvg, SaysWhatItShows) {
  const std::string file = svg(chart_of({{"CTRLED", {1.5, 2}, {40'000, 30'000}}}));
  EXPECT_TRUE(is_well_formed(file));
  const std::string text = visible(file);
  for (const char* word : {"birch", "threshold T", "dilated voxels", "CTRLED", "40,000", "1.5"}) {
    EXPECT_NE(text.find(word), std::string::npos) << word << " in\n" << text;
  }
}

TEST_F(ChartSvg, ScalesWithThePage) {
  const std::string file = svg(chart_of({}));
  EXPECT_EQ(count(file, "<svg[^>]*viewBox=\"0 0 640 "), 1);
  EXPECT_EQ(count(file, "<svg[^>]* (width|height)="), 0);
}

TEST_F(ChartSvg, IsTheSameEveryTime) {
  const Chart chart = chart_of({{"a", {1, 2, 3}, {1, 5, 3}}, {"b", {1, 2, 3}, {2, 2, 0}}});
  EXPECT_EQ(svg(chart), svg(chart));
}

TEST_F(ChartSvg, TakesAnyText) {
  Chart chart = chart_of({{"L&D 'old' {x} \\n @ ^2 &#955; \xFF", {1, 2}, {1, 2}}});
  chart.title = "O'Neil <b>\"q\"</b> $HOME `ls`\nunset label; a < b & birch_2";
  const std::string file = svg(chart);
  EXPECT_TRUE(is_well_formed(file)) << file;
  const std::string text = visible(file);
  EXPECT_NE(text.find("L&amp;D 'old' {x} \\n @ ^2 &amp;#955; \uFFFD\n"), std::string::npos) << text;
  EXPECT_NE(text.find("O'Neil &lt;b>\"q\"&lt;/b> $HOME `ls` unset label; a &lt; b &amp; birch_2\n"),
            std::string::npos)
      << text;
}

TEST_F(ChartSvg, SetsSubscripts) {
  const std::string file = svg(chart_of({{"R_max", {1}, {1}}}));
  EXPECT_NE(visible(file).find("Rmax\n"), std::string::npos) << visible(file);
}

/// The number of strokes in the path of the line `name`; a gap begins a new stroke.
int strokes(const std::string& file, const std::string& name) {
  const std::size_t group = file.find("<title>" + name + "</title>");
  const std::size_t path = file.find(" d='", group);
  return count(file.substr(path, file.find('\'', path + 4) - path), "M");
}

TEST_F(ChartSvg, BreaksALineAtAGap) {
  EXPECT_EQ(strokes(svg(chart_of({{"a", {1, 2, 3, 4, 5}, {1, 2, 3, 4, 5}}})), "a"), 1);
  EXPECT_EQ(strokes(svg(chart_of({{"a", {1, 2, 3, 4, 5}, {1, 2, kNan, 4, 5}}})), "a"), 2);
}

int markers(const std::string& file) { return count(file, "<use xlink:href='#gpPt[0-9]+' tran"); }

TEST_F(ChartSvg, MarksASinglePointAndPointsBetweenGaps) {
  const int legend = 1;
  EXPECT_EQ(markers(svg(chart_of({{"a", {2}, {7}}}))), legend + 1);
  std::vector<double> x(200), y(200, kNan);
  for (int i = 0; i < 200; ++i) x[i] = i;
  y[1] = y[77] = 3;
  EXPECT_EQ(markers(svg(chart_of({{"a", x, y}}))), legend + 2);
}

TEST_F(ChartSvg, MarksFewOfManyPoints) {
  std::vector<double> x(200), y(200, 1.0);
  for (int i = 0; i < 200; ++i) x[i] = i;
  EXPECT_EQ(markers(svg(chart_of({{"", x, y}}))), 11);
}

TEST_F(ChartSvg, DrawsNothingWhereNothingIs) {
  EXPECT_TRUE(is_well_formed(svg(Chart{})));
  EXPECT_TRUE(is_well_formed(svg(chart_of({}))));
  EXPECT_TRUE(is_well_formed(svg(chart_of({{"a", {}, {}}, {"b", {1, kNan}, {kNan, 2}}}))));
}

TEST_F(ChartSvg, OneNameLooksTheSameInAllPanels) {
  Chart chart = chart_of({{"a", {1}, {1}}, {"b", {1}, {2}}});
  chart.panels.push_back({"off-site vertices", {{"b", {1}, {3}}}});
  const std::string file = svg(chart);
  EXPECT_EQ(count(visible(file), "\nb\n"), 1);
  // b's marker is in the legend and in both panels.
  EXPECT_EQ(count(file, "#gpPt4' tran"), 3);
}

TEST(ChartLayout, LegendStaysClearOfTitleAndPanels) {
  for (int lines = 0; lines <= 12; ++lines) {
    std::vector<std::string> names;
    for (int i = 0; i < lines; ++i) names.push_back("R_max = 2.5, line " + std::to_string(i));
    Chart chart = chart_of({});
    chart.panels.resize(2);
    const ChartLayout layout = lay_out(chart, names);
    for (const ChartText& name : layout.legend) {
      EXPECT_GT(name.y - name.size, layout.title.y);
      EXPECT_LT(name.y, layout.panels[0].heading.y - kLabelSize);
      EXPECT_LE(name.x + text_width(name.text, name.size), kChartWidth);
    }
    EXPECT_LT(layout.panels[0].right, layout.panels[1].left);
    EXPECT_LT(layout.panels[1].foot.y, layout.height);
  }
}

TEST(ChartLayout, LongTextsAreSetSmaller) {
  Chart chart = chart_of({});
  chart.title = std::string(200, 'x');
  const ChartLayout layout = lay_out(chart, {chart.title});
  EXPECT_LE(text_width(chart.title, layout.title.size), kChartWidth);
  EXPECT_LE(layout.legend[0].x + text_width(chart.title, layout.legend[0].size), kChartWidth);
}

TEST(ChartWithoutGnuplot, SaysWhatToInstall) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  EXPECT_FALSE(can_draw_charts());
  try {
    svg(chart_of({}));
    ADD_FAILURE() << "a chart without gnuplot";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::output);
    EXPECT_NE(error.remedy().find("gnuplot-nox"), std::string::npos) << error.remedy();
  }
  ::setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace leafhull
