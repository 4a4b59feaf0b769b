// SPDX-License-Identifier: Apache-2.0
// The search for R_max, on known functions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/find_radius.h"

namespace leafhull {
namespace {

using Dilation = std::function<double(double)>;

constexpr double kStarts[] = {1, 1.5, 3.5, 7.5, 14};

struct Search {
  RadiusFound found;
  std::size_t calls;
};

/// Searches for R_max and checks what must hold for every search.
Search search(double wanted, double start, const Dilation& dilation) {
  std::set<double> radii;
  double nearest = HUGE_VAL;
  std::size_t calls = 0;
  const RadiusFound found = *find_radius(wanted, start, [&](double radius) {
    ++calls;
    EXPECT_TRUE(radii.insert(radius).second) << radius << " is tried twice";
    EXPECT_GE(radius, kSmallestRadiusMax * (1 - 1e-12));
    EXPECT_LE(radius, kLargestRadiusMax * (1 + 1e-12));
    nearest = std::min(nearest, std::abs(dilation(radius) - wanted));
    return dilation(radius);
  });
  EXPECT_LE(calls, 16u);
  EXPECT_TRUE(radii.contains(found.radius)) << "it is one that was tried";
  EXPECT_EQ(found.dilation, dilation(found.radius));
  EXPECT_EQ(std::abs(found.dilation - wanted), nearest) << "it is the nearest of them";
  EXPECT_EQ(found.reached, nearest <= 0.01);
  return {found, calls};
}

/// Rises from 0.1, by `slope` for each factor e of the radius.
Dilation rising(double slope) {
  return [=](double radius) { return 0.1 + slope * std::log(radius / kSmallestRadiusMax); };
}

/// Rises to 0.5 at a radius of `top` and falls beyond; for a `top` of 4 to 0.3 or less.
Dilation peaked(double top) {
  return [=](double radius) {
    const double x = std::log(radius / top);
    return 0.5 - (x < 0 ? -0.25 * x : 0.15 * x);
  };
}

TEST(FindRadius, OnASlopeTakesFewCalls) {
  for (const double slope : {0.2, 0.25, 0.3, 0.5}) {
    const double most = rising(slope)(kLargestRadiusMax);
    for (const double wanted : {0.12, 0.2, 0.3, 0.4, 0.55, 0.8}) {
      if (wanted > most) continue;
      for (const double start : kStarts) {
        SCOPED_TRACE(testing::Message() << slope << ' ' << wanted << ' ' << start);
        const auto [found, calls] = search(wanted, start, rising(slope));
        EXPECT_TRUE(found.reached);
        EXPECT_NEAR(found.dilation, wanted, 0.004);
        EXPECT_LE(calls, 5u);
      }
    }
  }
}

TEST(FindRadius, TakesTheStartWhereItWillDo) {
  const auto [found, calls] = search(0.4, 3, [](double) { return 0.402; });
  EXPECT_EQ(calls, 1u);
  EXPECT_DOUBLE_EQ(found.radius, 3);
}

TEST(FindRadius, BeginsBetweenItsEnds) {
  EXPECT_EQ(search(0.3, 100, rising(0.25)).found.reached, true);
  EXPECT_EQ(search(0.3, 0.01, rising(0.25)).found.reached, true);
}

TEST(FindRadius, IsNotMisledByTheLatticesNoise) {
  for (const double rate : {1e3, 1e4, 1e5}) {
    const auto noisy = [=](double radius) {
      return rising(0.25)(radius) + 0.003 * std::sin(rate * radius);
    };
    for (const double wanted : {0.15, 0.3, 0.45, 0.6, 0.8}) {
      for (const double start : kStarts) {
        SCOPED_TRACE(testing::Message() << rate << ' ' << wanted << ' ' << start);
        const auto [found, calls] = search(wanted, start, noisy);
        EXPECT_TRUE(found.reached);
        EXPECT_LE(calls, 8u);
        EXPECT_NEAR(rising(0.25)(found.radius), wanted, 0.013);
      }
    }
  }
}

TEST(FindRadius, OnABendIsNotStuckAtOneEnd) {
  // The function is flat at first and then steep, or the other way round.
  for (const double power : {0.5, 5.0, 10.0}) {
    const auto bent = [=](double radius) {
      const double x = std::log(radius / kSmallestRadiusMax);
      return 0.1 + 0.8 * std::pow(x / std::log(kLargestRadiusMax / kSmallestRadiusMax), power);
    };
    for (const double wanted : {0.15, 0.3, 0.5, 0.7, 0.85}) {
      for (const double start : kStarts) {
        SCOPED_TRACE(testing::Message() << power << ' ' << wanted << ' ' << start);
        const auto [found, calls] = search(wanted, start, bent);
        EXPECT_TRUE(found.reached);
        EXPECT_LE(calls, 12u);
      }
    }
  }
}

TEST(FindRadius, OnStepsTakesTheNearest) {
  const auto stepped = [](double radius) {
    return std::round(rising(0.25)(radius) / 0.016) * 0.016;
  };
  for (const double wanted : {0.2, 0.3, 0.4, 0.504, 0.7}) {
    for (const double start : kStarts) {
      SCOPED_TRACE(testing::Message() << wanted << ' ' << start);
      EXPECT_TRUE(search(wanted, start, stepped).found.reached);
    }
  }
}

TEST(FindRadius, OnAPeakIsReachedFromEitherSide) {
  for (const double top : {2.0, 4.0, 8.0}) {
    for (const double wanted : {0.3, 0.35, 0.4, 0.47, 0.495}) {
      if (wanted < peaked(top)(kSmallestRadiusMax)) continue;
      for (const double start : kStarts) {
        SCOPED_TRACE(testing::Message() << top << ' ' << wanted << ' ' << start);
        EXPECT_TRUE(search(wanted, start, peaked(top)).found.reached);
      }
    }
  }
}

TEST(FindRadius, OnAPeakIsReachedWhereOnlyItsLeftIsLowEnough) {
  for (const double wanted : {0.13, 0.2, 0.25}) {
    for (const double start : kStarts) {
      SCOPED_TRACE(testing::Message() << wanted << ' ' << start);
      const auto [found, calls] = search(wanted, start, peaked(4));
      EXPECT_TRUE(found.reached);
      EXPECT_LT(found.radius, 4);
    }
  }
}

TEST(FindRadius, OfWhatIsTooMuchIsTheLargest) {
  for (const double start : kStarts) {
    SCOPED_TRACE(start);
    const RadiusFound found = search(0.95, start, rising(0.25)).found;
    EXPECT_FALSE(found.reached);
    EXPECT_NEAR(found.radius, kLargestRadiusMax, 1e-9);
  }
}

TEST(FindRadius, OfWhatIsTooLittleIsTheSmallest) {
  for (const double start : kStarts) {
    SCOPED_TRACE(start);
    const RadiusFound found = search(0.05, start, rising(0.25)).found;
    EXPECT_FALSE(found.reached);
    EXPECT_NEAR(found.radius, kSmallestRadiusMax, 1e-9);
  }
}

TEST(FindRadius, AboveAPeakIsNearIt) {
  for (const double top : {2.0, 4.0, 8.0}) {
    for (const double start : kStarts) {
      SCOPED_TRACE(testing::Message() << top << ' ' << start);
      const RadiusFound found = search(0.6, start, peaked(top)).found;
      EXPECT_FALSE(found.reached);
      EXPECT_NEAR(found.dilation, 0.5, 0.03);
    }
  }
}

}  // namespace
}  // namespace leafhull
