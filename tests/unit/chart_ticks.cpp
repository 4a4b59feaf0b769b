// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "chart/ticks.h"

namespace leafhull {
namespace {

std::string texts(const Axis& axis) {
  std::string joined;
  for (const Tick& tick : axis.ticks) joined += (joined.empty() ? "" : " ") + tick.text;
  return joined;
}

TEST(ChartTicks, ValuesStartAtZeroAndEndAtARoundNumber) {
  const Axis axis = value_axis({182'000, 120'000});
  EXPECT_EQ(axis.low, 0);
  EXPECT_EQ(axis.high, 200'000);
  EXPECT_EQ(texts(axis), "0 50,000 100,000 150,000 200,000");
}

TEST(ChartTicks, LargeAndSmallValuesAreShort) {
  EXPECT_EQ(texts(value_axis({1'500'000})), "0 0.5 M 1 M 1.5 M");
  EXPECT_EQ(texts(value_axis({0.3})), "0 0.1 0.2 0.3");
}

TEST(ChartTicks, NegativeValuesAreOnTheAxis) {
  EXPECT_EQ(texts(value_axis({-900, 2000})), "-1,000 0 1,000 2,000");
}

TEST(ChartTicks, NothingAndZerosGiveAnAxis) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& values : {std::vector<double>{}, {0, 0}, {kNan, HUGE_VAL}}) {
    EXPECT_EQ(value_axis(values).low, 0);
    EXPECT_EQ(value_axis(values).high, 1);
  }
  EXPECT_LT(parameter_axis({}, 30).low, parameter_axis({}, 30).high);
  EXPECT_TRUE(parameter_axis({kNan}, 30).ticks.empty());
}

TEST(ChartTicks, ParametersAreMarkedAtTheValues) {
  EXPECT_EQ(texts(parameter_axis({1.5, 1.75, 2, 2.5}, 40)), "1.5 1.75 2 2.5");
}

TEST(ChartTicks, EveryOtherParameterIsMarkedWhereNotAllFit) {
  EXPECT_EQ(texts(parameter_axis({1, 1.25, 1.5, 1.75, 2}, 20)), "1 1.5 2");
}

TEST(ChartTicks, UnevenParametersAreMarkedAtRoundNumbers) {
  EXPECT_EQ(texts(parameter_axis({0.01, 0.02, 7, 20}, 30)), "5 10 15 20");
}

TEST(ChartTicks, OneParameterHasRoomAround) {
  const Axis axis = parameter_axis({2}, 20);
  EXPECT_LT(axis.low, 2);
  EXPECT_GT(axis.high, 2);
  EXPECT_EQ(texts(axis), "2");
}

}  // namespace
}  // namespace leafhull
