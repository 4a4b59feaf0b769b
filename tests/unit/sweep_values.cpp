// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "leafhull/error.h"
#include "leafhull/sweep.h"
#include "unit/option_row.h"

namespace leafhull {
namespace {

using test::option_row;

using Texts = std::vector<std::string>;

Texts values(std::string_view text, std::string_view option = "threshold") {
  return swept_option(option_row(option), text).values;
}

std::string refusal(std::string_view text, std::string_view option = "threshold") {
  try {
    values(text, option);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_FALSE(error.remedy().empty());
    return error.what();
  }
  return "accepted";
}

TEST(SweepValues, RangesHoldBothEnds) {
  EXPECT_EQ(values("1.5:2.5:0.25"), (Texts{"1.5", "1.75", "2", "2.25", "2.5"}));
  EXPECT_EQ(values("2:2:1"), Texts{"2"});
  EXPECT_EQ(values("1:2:0.4"), (Texts{"1", "1.4", "1.8"}));
  EXPECT_EQ(values("64:128:32", "resolution"), (Texts{"64", "96", "128"}));
}

TEST(SweepValues, RangesAreFreeOfBinaryFractions) {
  EXPECT_EQ(values("0.1:0.7:0.1"), (Texts{"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"}));
  EXPECT_EQ(values("-0.3:0.1:0.1", "band-low"), (Texts{"-0.3", "-0.2", "-0.1", "0", "0.1"}));
  EXPECT_EQ(values("0.8:0.98:0.06", "coverage"), (Texts{"0.8", "0.86", "0.92", "0.98"}));
  EXPECT_EQ(values("1e-7:3e-7:1e-7"), (Texts{"1e-07", "2e-07", "3e-07"}));
  EXPECT_EQ(values("100000:300000:1e5"), (Texts{"100000", "200000", "300000"}));
}

TEST(SweepValues, AnEndWithinRoundingOfAStepIsIncluded) {
  EXPECT_EQ(values("0:1:0.1", "band-low").size(), 11u);
  EXPECT_EQ(values("0:1.00000000005:1", "band-low"), (Texts{"0", "1"}));
  EXPECT_EQ(values("0:0.9999999999:1", "band-low"), (Texts{"0", "1"}));
  EXPECT_EQ(values("0:0.99999:1", "band-low"), (Texts{"0"}));
}

TEST(SweepValues, ListsKeepTheirOrder) {
  EXPECT_EQ(values("2.50,1,1e1"), (Texts{"2.5", "1", "10"}));
  EXPECT_EQ(values("isotropic,controlled", "method"), (Texts{"isotropic", "controlled"}));
}

TEST(SweepValues, PercentagesAreThresholdPercent) {
  const SweptOption range = swept_option(option_row("threshold"), "30%:60%:10%");
  EXPECT_EQ(range.row->name, "threshold-percent");
  EXPECT_EQ(range.values, (Texts{"30", "40", "50", "60"}));
  EXPECT_EQ(swept_option(option_row("threshold"), "30%,45%").row->name, "threshold-percent");
  EXPECT_EQ(swept_option(option_row("threshold"), "30,45").row->name, "threshold");
  EXPECT_NE(refusal("30%,45").find("mixes"), std::string::npos);
  EXPECT_NE(refusal("30:60:10%").find("mixes"), std::string::npos);
  EXPECT_NE(refusal("1%,2%", "radius-max").find("numbers"), std::string::npos);
}

TEST(SweepValues, PercentagesOfTheBandAndOfFractions) {
  const SweptOption band = swept_option(option_row("band-low"), "10%:30%:10%");
  EXPECT_EQ(band.row->name, "band-low-percent");
  EXPECT_EQ(band.values, (Texts{"10", "20", "30"}));
  const SweptOption coverage = swept_option(option_row("coverage"), "85%,92.5%");
  EXPECT_EQ(coverage.row->name, "coverage");
  EXPECT_EQ(coverage.values, (Texts{"0.85", "0.925"}));
  EXPECT_EQ(values("5%:25%:10%", "coverage"), (Texts{"0.05", "0.15", "0.25"}));
}

TEST(SweepValues, OneValueIsHandedOnUnread) {
  for (const char* text : {"2", "40%", "x", ""}) EXPECT_EQ(values(text), Texts{text});
  EXPECT_EQ(values("*a,b:c*", "leaves"), Texts{"*a,b:c*"});
  EXPECT_EQ(values("1,2", "leaf-scale"), Texts{"1,2"});
}

TEST(SweepValues, WhatIsNoRangeAndNoListIsRefused) {
  for (const char* text : {"1:2", "1:2:3:4", ":", "1::2", "1:2:x", "a:b:c", "1,,2", ",", "1,x",
                           "nan,1", "inf:1:1", "1:inf:1", "1:2:nan", "1 ,2", "1:2:0.5,3"}) {
    EXPECT_NE(refusal(text).find(std::string("'") + text + "'"), std::string::npos) << text;
  }
}

TEST(SweepValues, RangesThatLeadNowhereAreRefused) {
  EXPECT_NE(refusal("2:1:0.5").find("backwards"), std::string::npos);
  for (const char* text : {"1:2:0", "1:2:-0.5", "2:1:-0.5"}) {
    EXPECT_NE(refusal(text).find("step"), std::string::npos) << text;
  }
  EXPECT_NE(refusal("1:2:1e-6").find("1000001 values"), std::string::npos);
  EXPECT_NE(refusal("1:2:1e-300").find("values"), std::string::npos);
}

TEST(SweepValues, AValueTwiceIsRefused) {
  EXPECT_NE(refusal("2,3,2.0").find("2 twice"), std::string::npos);
  EXPECT_NE(refusal("thin,fat,thin", "style").find("thin twice"), std::string::npos);
}

TEST(SweepValues, CombinationsMultiply) {
  const std::vector<SweptOption> swept = {
      swept_option(option_row("threshold"), "1:5:1"),
      swept_option(option_row("method"), "isotropic,controlled")};
  EXPECT_EQ(combination_count(swept), 10u);
  const SweptOption many = swept_option(option_row("threshold"), "1:1000:1");
  EXPECT_THROW(combination_count(std::vector<SweptOption>(5, many)), Error);
}

}  // namespace
}  // namespace leafhull
