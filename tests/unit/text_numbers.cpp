// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "text/choice.h"
#include "text/numbers.h"
#include "text/text.h"

namespace leafhull {
namespace {

TEST(Numbers, AreWrittenShortest) {
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(shortest(1e300), "1e+300");
  EXPECT_EQ(*parsed<double>(shortest(1.0 / 3)), 1.0 / 3);
}

TEST(Numbers, AreRounded) {
  EXPECT_EQ(significant(1234.5678, 6), "1234.57");
  EXPECT_EQ(significant(2.5, 6), "2.5");
  EXPECT_EQ(fixed(2.345, 1), "2.3");
  EXPECT_EQ(significant(1e-5, 3), "1e-05");
  EXPECT_EQ(significant(1e6, 6), "1e+06");
  EXPECT_EQ(fixed(-0.04, 1), "-0.0");
  EXPECT_EQ(fixed(1e308, 2).size(), 309u + 3);
}

TEST(Numbers, AreGrouped) {
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1'234'567), "1,234,567");
  EXPECT_EQ(grouped(std::string("-123")), "-123");
  EXPECT_EQ(grouped(std::string("-1234")), "-1,234");
  EXPECT_EQ(grouped(std::string("1234.5678")), "1,234.5678");
  EXPECT_EQ(grouped(std::string("1e+07")), "1e+07");
}

TEST(Numbers, AreTheWholeText) {
  EXPECT_EQ(parsed<double>("-1.5e2"), -150);
  EXPECT_EQ(parsed<int>("12"), 12);
  EXPECT_FALSE(parsed<int>("12x"));
  EXPECT_FALSE(parsed<int>("1.5"));
  EXPECT_FALSE(parsed<double>(""));
}

TEST(Lists, LeaveEmptyWordsOut) {
  EXPECT_EQ(joined(std::array<std::string_view, 3>{"a", "", "b"}, "; "), "a; b");
  EXPECT_EQ(joined(std::vector<int>{1, 2}, ", ", [](int i) { return std::to_string(i); }), "1, 2");
}

TEST(LowerCase, LeavesOtherLettersAlone) { EXPECT_EQ(in_lower_case("AbZ_Ä1"), "abz_Ä1"); }

}  // namespace
}  // namespace leafhull
