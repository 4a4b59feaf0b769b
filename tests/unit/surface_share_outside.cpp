// SPDX-License-Identifier: Apache-2.0
// The share of points on the leaves that the shape leaves outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "surface/hollows.h"
#include "surface/mesh_components.h"
#include "surface/metrics.h"
#include "surface/polygonise.h"
#include "unit/surface_test_fields.h"

namespace leafhull {
namespace {

using Density = std::function<double(Vec3d)>;

constexpr Coord kFarLow{-24, -16, -16}, kFarHigh{24, 16, 16};

/// The density is 2 in the middle and falls to 1 at the radius.
Density ball_around(Vec3d centre, double radius) {
  return [=](Vec3d p) {
    const Vec3d d = p - centre;
    return std::max(0.0, 2 - dot(d, d) / (radius * radius));
  };
}

Density together(const Density& a, const Density& b) {
  return [=](Vec3d p) { return std::max(a(p), b(p)); };
}

/// A ball with a round hollow.
Density shell_around(double radius, Vec3d middle, double hollow) {
  return [=, outer = ball_around({}, radius)](Vec3d p) {
    return std::min(outer(p), std::pow(length(p - middle) / hollow, 2));
  };
}

/// The share outside a field with T = 1, whose pieces below `least` of the largest are dropped.
double outside(const Field& field, std::span<const Vec3d> places, double least = 0) {
  Polygons polygons = polygonise(field, 0);
  const ComponentCount pieces = drop_small_components(polygons, least);
  return share_outside(field, places, pieces.dropped_cells);
}

double outside(const Density& density, std::span<const Vec3d> places, double least = 0) {
  return outside(field_of(density, 1, kFarLow, kFarHigh), places, least);
}

TEST(ShareOutside, IsOfPlacesBelowT) {
  const Density one = ball_around({0.3, 0.2, 0.1}, 8.4);
  std::vector<Vec3d> places;
  std::size_t below = 0;
  for (double x = -12; x <= 12; x += 0.61) {
    for (double y = -12; y <= 12; y += 0.73) {
      places.emplace_back(x, y, 0.37);
      below += one(places.back()) < 1;
    }
  }
  EXPECT_NEAR(outside(one, places), static_cast<double>(below) / static_cast<double>(places.size()),
              0.005);
}

TEST(ShareOutside, GoesByTheSamplesAroundIt) {
  const Density plane = [](Vec3d p) { return 1.25 - 0.1 * p.x; };
  const Field field = field_of(plane, 1, kFarLow, kFarHigh);
  const std::vector<Vec3d> places{{2.4, 0.1, 0.2}, {2.6, 0.1, 0.2}};
  EXPECT_EQ(share_outside(field, places, {}), 0.5);
}

TEST(ShareOutside, AHollowThatIsDroppedIsFilled) {
  const Density hollow = shell_around(12, {3, 0, 0}, 3);
  const std::vector<Vec3d> places{{-5, 0, 0}, {-2, 0, 0}, {8, 0, 0}, {0, 8, 0}};
  EXPECT_EQ(outside(hollow, places), 0);
  EXPECT_EQ(outside(hollow, places, 0.5), 0);
}

TEST(ShareOutside, TakesInAHollowThatWasFilled) {
  const Density hollow = shell_around(10, {}, 5);
  const std::vector<Vec3d> places{{0, 0, 0}, {2, 1, -2}, {7, 0, 0}, {12, 0, 0}};
  EXPECT_EQ(outside(hollow, places), 0.75);
  EXPECT_EQ(outside(fill_hollows(field_of(hollow, 1, kFarLow, kFarHigh)), places), 0.25);
}

TEST(ShareOutside, CountsWhatTheLatticeDoesNotSee) {
  // The speck is much smaller than a cell and lies between its corners.
  const Density speck = together(ball_around({-8, 0, 0}, 5), ball_around({8.5, 0.5, 0.5}, 0.4));
  const std::vector<Vec3d> places{{8.5, 0.5, 0.5}, {-8, 0, 0}};
  EXPECT_GT(speck(places[0]), 1);
  EXPECT_EQ(outside(speck, places), 0.5);
}

TEST(ShareOutside, CountsPiecesThatAreDropped) {
  for (const double sign : {-1.0, 1.0}) {
    const Vec3d large(-8 * sign, 0, 0), small(12 * sign, 0, 0);
    const Density two = together(ball_around(large, 7.3), ball_around(small, 4.2));
    // Points in the small ball's middle and close to its surface on all sides, and in the large
    // ball.
    const std::vector<Vec3d> places{small,
                                    small + Vec3d(3.9, 0, 0),
                                    small + Vec3d(-3.9, 0, 0),
                                    small + Vec3d(0, 3.9, 0.1),
                                    small + Vec3d(0.1, 0.2, -3.9),
                                    large,
                                    large + Vec3d(7, 0, 0),
                                    large + Vec3d(-7, 0, 0)};
    EXPECT_EQ(outside(two, places), 0);
    EXPECT_EQ(outside(two, places, 0.5), 5 / 8.0);
  }
}

TEST(ShareOutside, CountsAPieceThatIsDroppedFromAHollow) {
  const Density nested = together(shell_around(14, {}, 9), ball_around({1, 0, 0}, 3.2));
  const std::vector<Vec3d> places{{1, 0, 0}, {2, 1, 0}, {-12, 0, 0}, {12, 0, 0}};
  EXPECT_EQ(outside(nested, places), 0);
  EXPECT_EQ(outside(nested, places, 0.1), 0.5);
}

}  // namespace
}  // namespace leafhull
