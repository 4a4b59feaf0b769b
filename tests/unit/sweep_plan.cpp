// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "leafhull/error.h"
#include "sweep/plots.h"
#include "sweep/sheets.h"
#include "sweep/tables.h"
#include "unit/option_row.h"

namespace leafhull {
namespace {

using test::option_row;

LeafSet leaf() {
  LeafSet leaves;
  leaves.vertices = {{{1, 2, 3}, {0, 0, 1}, {1, 0, 0}, 0.5F, 0.25F, 0}};
  leaves.leaf_count = 1;
  return leaves;
}

const DeviceInfo kDevice = [] {
  DeviceInfo device;
  device.name = "abacus", device.platform = "wood", device.variant = "vector";
  return device;
}();

SweptOption swept(std::string_view option, std::string_view values) {
  return swept_option(option_row(option), values);
}

/// A plan over methods and thresholds.
SweepPlan plan(const std::string& thresholds, const std::string& methods,
               const Options& options = {}) {
  return plan_sweep(options, {swept("threshold", thresholds), swept("method", methods)});
}

std::map<std::size_t, Json> rows_of(const SweepPlan& plan) {
  std::map<std::size_t, Json> rows;
  for (std::size_t i = 0; i < plan.combinations().size(); ++i) {
    SeriesEntry entry;
    Report& report = entry.report;
    report.options = plan.combinations()[i];
    report.threshold = *report.options.threshold;
    report.metrics.dilated_voxels = 100 + i;
    report.metrics.off_site_sampled = 200 + i;
    report.seconds = {{"field", 0.5}, {"total", 0.5}};
    if (i != 1) {
      entry.mesh.positions.resize(3);
    } else {
      entry.failure = "it needs 7 GiB, and 3 are there. Try \"less\".";
    }
    rows[i] = row_of(i, "pictures/" + picture_name(plan, i), entry);
  }
  return rows;
}

TEST(SweepPlan, TheLastOptionChangesFastest) {
  const SweepPlan sweep = plan("1,2,3", "isotropic,controlled");
  using Values = std::vector<std::string_view>;
  EXPECT_EQ(values_of(sweep, 0), (Values{"isotropic", "1"}));
  EXPECT_EQ(values_of(sweep, 2), (Values{"isotropic", "3"}));
  EXPECT_EQ(values_of(sweep, 3), (Values{"controlled", "1"}));
  EXPECT_EQ(picture_name(sweep, 4), "5-method-controlled-threshold-2.png");
}

TEST(SweepPlan, CombinesWhatOptionsSay) {
  Options options;
  options.flatness = 0.5;
  const SweepPlan sweep =
      plan_sweep(options, {swept("falloff", "1,3"), swept("coverage", "80%:90%:10%"),
                           swept("style", "luft-deussen,thin"), swept("resolution", "32")});
  std::vector<std::string_view> names;
  for (const SweptOption& option : sweep.swept()) names.push_back(option.row->name);
  EXPECT_EQ(names, (std::vector<std::string_view>{"style", "coverage", "falloff", "resolution"}));
  ASSERT_EQ(sweep.combinations().size(), 8u);
  const Options& third = sweep.combinations()[2];
  EXPECT_EQ(third.style, Style::paper_previous);
  EXPECT_EQ(third.coverage, 0.9);
  EXPECT_EQ(third.falloff, 1);
  EXPECT_EQ(third.resolution, 32);
  EXPECT_EQ(third.flatness, 0.5);
  EXPECT_EQ(third.method, Method::isotropic) << "resolved";
  EXPECT_EQ(sweep.combinations()[7].style, Style::thin);
}

TEST(SweepPlan, ReadsASinglePercentage) {
  const SweepPlan sweep = plan_sweep({}, {swept("threshold", "40%")});
  EXPECT_EQ(sweep.swept().front().row->name, "threshold-percent");
  EXPECT_EQ(sweep.combinations().at(0).threshold_percent, 40);
}

/// The usage error of a sweep; empty where it is accepted.
std::string refusal(std::vector<SweptOption> swept) {
  try {
    (void)plan_sweep({}, std::move(swept));
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(error.remedy(), "");
    return error.what();
  }
  return "";
}

TEST(SweepPlan, RefusesWhatCannotBeSwept) {
  EXPECT_EQ(refusal({}), "no option is swept");
  EXPECT_EQ(refusal({swept("threshold", "1,2"), swept("method", "isotropic,controlled"),
                     swept("threshold", "3,4")}),
            "--threshold is swept twice");
  EXPECT_EQ(refusal({{&option_row("leaf-scale"), {"1", "2"}}}), "--leaf-scale cannot be swept");
  EXPECT_EQ(refusal({{&option_row("threshold"), {}}}), "--threshold has no values");
  EXPECT_EQ(refusal({{&option_row("threshold"), {"1", "two"}}}),
            "--threshold 'two' is not a number");
  EXPECT_EQ(refusal({swept("falloff", "1,1.5")}), "--falloff '1.5' is not a whole number");
  EXPECT_NE(refusal({swept("method", "isotropic,contolled")}).find("contolled"), std::string::npos);
  EXPECT_NE(refusal({swept("falloff", "1,9")}).find("out of range"), std::string::npos);
  EXPECT_NE(refusal({swept("threshold", "1:1000:1"), swept("radius-max", "1:1000:1")})
                .find("more than a sweep can hold"),
            std::string::npos);
}

TEST(SweepPlan, PictureNamesSort) {
  const SweepPlan sweep = plan("1:120:1", "isotropic,controlled");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 240; ++i) names.push_back(picture_name(sweep, i));
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
}

std::string difference(const LeafSet& leaves, const SweepPlan& sweep, const DeviceInfo& device) {
  const Json here = identity(leaf(), plan("1,2", "isotropic,controlled"), kDevice);
  try {
    check_same_sweep(identity(leaves, sweep, device), here, "out");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(error.remedy().find("--restart"), std::string::npos);
    return error.what();
  }
  return "the same";
}

TEST(SweepPlan, TellsSweepsApart) {
  const SweepPlan same = plan("1,2", "isotropic,controlled");
  EXPECT_EQ(difference(leaf(), same, kDevice), "the same");

  LeafSet moved = leaf();
  moved.vertices[0].position.z = std::nextafter(3, 4);
  EXPECT_NE(difference(moved, same, kDevice).find("tree"), std::string::npos);

  LeafSet counted = leaf();
  counted.leaf_count = 2;
  EXPECT_NE(difference(counted, same, kDevice).find("tree"), std::string::npos);

  DeviceInfo other = kDevice;
  other.name = "slide rule";
  EXPECT_NE(difference(leaf(), same, other).find("slide rule"), std::string::npos);

  const std::string values = difference(leaf(), plan("1,3", "isotropic,controlled"), kDevice);
  EXPECT_NE(values.find("--threshold is 1.0, 3.0, not 1.0, 2.0"), std::string::npos) << values;

  Options options;
  options.resolution = 32;
  const SweepPlan coarse = plan("1,2", "isotropic,controlled", options);
  EXPECT_NE(difference(leaf(), coarse, kDevice).find("--preset is unset"), std::string::npos);
}

TEST(SweepPlan, PlotsHaveALineForEachOtherCombination) {
  const SweepPlan sweep = plan("3,1,2", "isotropic,controlled");
  const std::vector<Plot> drawn = plots(sweep, rows_of(sweep), "tree.glb");
  ASSERT_EQ(drawn.size(), 1u);  // methods are not numbers
  EXPECT_EQ(drawn[0].file, "plot-threshold.svg");
  const Chart& chart = drawn[0].chart;
  EXPECT_EQ(chart.x_label, "threshold (density)");
  ASSERT_EQ(chart.panels.size(), 2u);
  const ChartLine& first = chart.panels[0].lines.at(0);
  EXPECT_EQ(first.name, "method isotropic");
  EXPECT_EQ(first.x, (std::vector<double>{1, 2, 3}));
  EXPECT_TRUE(std::isnan(first.y[0])) << "not computed: a gap";
  EXPECT_EQ(first.y[2], 100);
  EXPECT_EQ(chart.panels[1].lines.at(1).y, (std::vector<double>{204, 205, 203}));
}

TEST(SweepPlan, PlotsSayHowManyLinesTheyLeaveOut) {
  const SweepPlan sweep =
      plan_sweep({}, {swept("radius-max", "1:40:1"), swept("threshold", "1,2")});
  const Chart chart = plots(sweep, rows_of(sweep), "tree.glb").at(0).chart;
  const auto& lines = chart.panels[0].lines;
  EXPECT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines.front().name, "radius-max 1");
  EXPECT_EQ(lines.back().name, "radius-max 40");
  EXPECT_NE(chart.title.find("6 of 40 lines"), std::string::npos) << chart.title;
}

TEST(SweepPlan, PlotsLeaveOutNumbersBeforeNames) {
  const SweepPlan sweep = plan_sweep({}, {swept("method", "isotropic,uncontrolled,controlled"),
                                          swept("threshold", "1:7:1"), swept("flatness", "0.5,1")});
  const Chart chart = plots(sweep, rows_of(sweep), "tree.glb").at(1).chart;
  std::vector<std::string> names;
  for (const ChartLine& line : chart.panels[0].lines) names.push_back(line.name);
  EXPECT_EQ(names, (std::vector<std::string>{
                       "method isotropic, threshold 1", "method isotropic, threshold 7",
                       "method uncontrolled, threshold 1", "method uncontrolled, threshold 7",
                       "method controlled, threshold 1", "method controlled, threshold 7"}));
}

TEST(SweepPlan, SheetsHoldEveryCombinationOnce) {
  for (const char* thresholds : {"1,2,3", "1:9:1", "1:11:1", "1:99:1", "1:4321:1"}) {
    const SweepPlan sweep = plan(thresholds, "isotropic,controlled");
    const std::vector<Sheet> pages = sheets(sweep);
    std::size_t next = 0;
    for (const Sheet& page : pages) {
      EXPECT_EQ(page.begin, next);
      EXPECT_LT(page.begin, page.end);
      EXPECT_LE(page.end - page.begin, 80u);
      next = page.end;
    }
    EXPECT_EQ(next, sweep.combinations().size());
    EXPECT_EQ(pages.size() == 1, pages[0].file == "contact-sheet.png");
  }
  EXPECT_EQ(sheet_columns(plan("1:9:1", "isotropic,controlled")), 9);
  EXPECT_LE(sheet_columns(plan("1:99:1", "isotropic,controlled")), 10);
}

TEST(SweepPlan, TheTableBeginsWithWhatIsSwept) {
  const SweepPlan sweep = plan("1,2.5", "isotropic,controlled");
  const std::string table = csv(sweep, rows_of(sweep));
  EXPECT_EQ(table.find("method,threshold,T,dilated_voxels,"), 0u);
  EXPECT_NE(table.find("\nisotropic,1,1.0,100,"), std::string::npos);
  EXPECT_NE(table.find("\ncontrolled,2.5,2.5,103,"), std::string::npos);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 5);
  EXPECT_NE(table.find(",true,\"it needs 7 GiB, and 3 are there. Try \"\"less\"\".\",pictures/"),
            std::string::npos);
  const std::string first = table.substr(0, table.find('\n'));
  EXPECT_NE(first.find(",seconds_field,seconds_total,empty,failure,picture"), std::string::npos);
}

}  // namespace
}  // namespace leafhull
