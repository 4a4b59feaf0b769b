// SPDX-License-Identifier: Apache-2.0
// The threshold of trees whose leaves are the surfaces of filled crowns.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "density/control.h"

namespace leafhull {
namespace {

/// `count` densities from 0.95 to 1.05 times `middle`.
std::vector<WeightedDensity> even(double middle, int count, bool in_solid,
                                  std::uint64_t weight = 1) {
  std::vector<WeightedDensity> all;
  for (int i = 0; i < count; ++i) {
    const double share = 0.95 + 0.1 * i / (count - 1);
    all.push_back({static_cast<float>(middle * share), weight, in_solid});
  }
  return all;
}

std::vector<WeightedDensity> joined(std::vector<WeightedDensity> a,
                                    const std::vector<WeightedDensity>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(BelowFilm, AFilledCrownIsNone) {
  std::vector<WeightedDensity> sheet = even(1, 101, false), crown = even(1, 101, true);
  EXPECT_NEAR(below_film(sheet, 0.97).value_or(0), 0.6, 0.01);
  EXPECT_FALSE(below_film(crown, 0.97));
}

TEST(BelowFilm, IsWhereMostOfAllIsASheet) {
  std::vector<WeightedDensity> few = joined(even(1, 40, false), even(1, 60, true));
  EXPECT_FALSE(below_film(few, 0.9));
  std::vector<WeightedDensity> most = joined(even(1, 60, false), even(1, 40, true));
  EXPECT_NEAR(below_film(most, 0.9).value_or(0), 0.6, 0.01);
  std::vector<WeightedDensity> heavy = joined(even(1, 20, false, 5), even(1, 60, true));
  EXPECT_NEAR(below_film(heavy, 0.9).value_or(0), 0.6, 0.01);
}

TEST(BelowFilm, SortsWhatItIsGiven) {
  std::vector<WeightedDensity> densities{{3, 1, true}, {1, 2, false}, {2, 3, true}};
  (void)below_film(densities, 0.5);
  EXPECT_EQ(densities[0].density, 1);
  EXPECT_EQ(densities[0].weight, 2u);
  EXPECT_TRUE(densities[1].in_solid);
  EXPECT_EQ(densities[2].density, 3);
}

TEST(ClearOfSheets, TakesInFilledCrownsByTheirMiddle) {
  const auto of = [](double coverage, double quantile) {
    std::vector<WeightedDensity> crown = even(1, 101, true);
    return clear_of_sheets(crown, quantile, coverage);
  };
  EXPECT_NEAR(of(0.949, 0.96), 0.96, 1e-6) << "below 0.95 as it is";
  EXPECT_NEAR(of(0.95, 0.96), 0.27, 1e-6);
  EXPECT_NEAR(of(0.965, 0.96), 0.255, 1e-6);
  EXPECT_NEAR(of(0.98, 0.96), 0.24, 1e-6);
  EXPECT_NEAR(of(0.985, 0.96), 0.18, 1e-6);
  EXPECT_NEAR(of(0.99, 0.96), 0.12, 1e-6);
  EXPECT_NEAR(of(1, 0.96), 0.12, 1e-6);
  EXPECT_NEAR(of(0.99, 0.1), 0.1, 1e-6) << "never raised";
}

TEST(ClearOfSheets, FallsSteadilyAsMoreIsAskedFor) {
  double last = HUGE_VAL;
  for (double coverage = 0.95; coverage <= 1; coverage += 0.001) {
    std::vector<WeightedDensity> crown = even(1, 101, true);
    const double threshold = clear_of_sheets(crown, 0.96, coverage);
    EXPECT_LE(threshold, last);
    EXPECT_GT(threshold, last == HUGE_VAL ? 0 : last - 0.03);
    last = threshold;
  }
}

TEST(ClearOfSheets, GoesByFilledCrownsWhereMostLeavesAreOnThem) {
  const auto of = [](int on_crowns, std::uint64_t weight = 1) {
    std::vector<WeightedDensity> both =
        joined(even(2, on_crowns, true), even(9, 100 - on_crowns, false, weight));
    return clear_of_sheets(both, 1.9, 0.95);
  };
  EXPECT_NEAR(of(60), 0.54, 0.01);
  EXPECT_NEAR(of(50), 0.54, 0.01);
  EXPECT_NEAR(of(40), 1.9, 1e-6);
  EXPECT_NEAR(of(60, 3), 1.9, 1e-6) << "most by weight";
}

}  // namespace
}  // namespace leafhull
