// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

/// A plan over methods and thresholds; its options hold only the threshold.
SweepPlan plan(const std::string& thresholds, const std::string& methods) {
  SweepPlan plan{{swept_option(option_row("method"), methods),
                  swept_option(option_row("threshold"), thresholds)},
                 {}};
  const std::size_t count = combination_count(plan.swept);
  for (std::size_t i = 0; i < count; ++i) {
    Options options;
    options.threshold = std::stod(std::string(values_of(plan, i)[1]));
    plan.combinations.push_back(resolve(options));
  }
  return plan;
}

std::map<std::size_t, Json> rows_of(const SweepPlan& plan) {
  std::map<std::size_t, Json> rows;
  for (std::size_t i = 0; i < plan.combinations.size(); ++i) {
    SeriesEntry entry;
    Report& report = entry.report;
    report.options = plan.combinations[i];
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

  SweepPlan coarse = same;
  for (Options& options : coarse.combinations) {
    options.preset.reset();
    options.resolution = 32;
  }
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
  SweepPlan sweep = plan("1,2", "isotropic,controlled");
  sweep.swept[0] = swept_option(option_row("radius-max"), "1:40:1");
  sweep.combinations.assign(80, sweep.combinations[0]);
  const Chart chart = plots(sweep, rows_of(sweep), "tree.glb").at(1).chart;
  const auto& lines = chart.panels[0].lines;
  EXPECT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines.front().name, "radius-max 1");
  EXPECT_EQ(lines.back().name, "radius-max 40");
  EXPECT_NE(chart.title.find("6 of 40 lines"), std::string::npos) << chart.title;
}

TEST(SweepPlan, PlotsLeaveOutNumbersBeforeNames) {
  SweepPlan sweep = plan("1:7:1", "isotropic,uncontrolled,controlled");
  sweep.swept.push_back(swept_option(option_row("flatness"), "0.5,1"));
  sweep.combinations.assign(42, sweep.combinations[0]);
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
    EXPECT_EQ(next, sweep.combinations.size());
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
