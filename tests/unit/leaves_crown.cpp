// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "leaves/crown.h"
#include "leaves_models.h"

namespace leafhull {
namespace {

using Random = std::mt19937;

/// Positions of leaves in a ball of radius 1.
std::vector<Vec3d> ball(std::size_t count, Vec3d middle = {}) {
  Random random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Vec3d> places;
  while (places.size() < count) {
    const double x = any(random), y = any(random);
    const Vec3d p(x, y, any(random));
    if (length(p) <= 1) places.push_back(p + middle);
  }
  return places;
}

std::vector<Vec3d> joined(std::vector<Vec3d> a, const std::vector<Vec3d>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Adds a square leaf across z with `along` * `along` vertices.
void add_leaf(LeafSet& leaves, Vec3d place, int along = 2, double side = 0.05) {
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < along; ++j) {
      const Vec3d offset(i / (along - 1.) - 0.5, j / (along - 1.) - 0.5, 0);
      leaves.vertices.push_back({place + offset * side,
                                 {0, 0, 1},
                                 {1, 0, 0},
                                 0.03f,
                                 0.03f,
                                 static_cast<std::uint32_t>(leaves.leaf_count)});
      leaves.bounds.include(leaves.vertices.back().position);
    }
  }
  ++leaves.leaf_count;
}

LeafSet leaves_at(const std::vector<Vec3d>& places) {
  LeafSet leaves;
  for (const Vec3d place : places) add_leaf(leaves, place);
  return leaves;
}

void expect_box(const Box& box, const Box& expected) {
  EXPECT_EQ(box.low, expected.low);
  EXPECT_EQ(box.high, expected.high);
}

void expect_no_strays(const LeafSet& leaves) {
  const Crown crown = find_crown(leaves);
  EXPECT_EQ(crown.strays, 0u);
  expect_box(crown.box, leaves.bounds);
}

/// Expects the strays to be found, and the crown to be the same to the bit as without them.
void expect_strays(const std::vector<Vec3d>& tree, const std::vector<Vec3d>& strays) {
  const LeafSet all = leaves_at(joined(tree, strays));
  const Crown crown = find_crown(all);
  EXPECT_EQ(crown.strays, strays.size());
  expect_box(crown.box, leaves_at(tree).bounds);
}

TEST(Crown, IsTheBoxOfAllLeavesWithoutStrays) {
  expect_no_strays(leaves_at(ball(1000)));
  expect_no_strays(leaves_at(ball(10)));
}

TEST(Crown, EndsWhereLeavesLieFarFromTheRest) {
  const std::vector<Vec3d> tree = ball(1000);
  for (const Vec3d towards : {Vec3d(1, 0, 0), Vec3d(0, -1, 0), Vec3d(0, 0, 1), Vec3d(-1, 1, -1)}) {
    std::vector<Vec3d> strays = ball(20);
    for (Vec3d& stray : strays) stray = stray + towards * 6;  // three times the crown's height
    expect_strays(tree, strays);
  }
}

TEST(Crown, ToldFarStraysByTheirDistance) {
  std::vector<Vec3d> places = ball(1000);
  places.push_back({0, -21, 0});
  places.push_back({11, 0, 0});
  const Crown crown = find_crown(leaves_at(places));
  EXPECT_EQ(crown.strays, 2u);
  EXPECT_NEAR(crown.farthest, 20, 0.2);
}

// Along each single axis these leaves follow each other closely, starting at the crown's edge.
TEST(Crown, StrewnLeavesAreStrays) {
  Random random(2);
  std::uniform_real_distribution<double> angle(0, 6.28);
  std::vector<Vec3d> strays;
  for (int i = 0; i < 20; ++i) {
    const double a = angle(random), r = 2.3 + 0.3 * i;
    strays.push_back({r * std::cos(a), -0.9, r * std::sin(a)});
  }
  expect_strays(ball(1000), strays);
}

TEST(Crown, OneLeafFarAwayIsAStray) { expect_strays(ball(10), {{0, -7, 0}}); }

TEST(Crown, HasNoStraysWhereTheyAreManyOrLeavesFew) {
  const auto tree_with = [](std::size_t strays) {
    return leaves_at(joined(ball(180), ball(strays, {0, 9, 0})));
  };
  EXPECT_EQ(find_crown(tree_with(20)).strays, 20u);
  expect_no_strays(tree_with(21));
  const auto tree_between = [](std::size_t strays) {
    return leaves_at(joined(joined(ball(180), ball(strays, {0, 9, 0})), ball(strays, {-9, 0, 0})));
  };
  EXPECT_EQ(find_crown(tree_between(10)).strays, 20u);
  expect_no_strays(tree_between(11));
  expect_no_strays(leaves_at({{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}, {0, 0.1, 0}, {9, 0, 0}}));
  expect_no_strays(leaves_at({{0, 0, 0}}));
}

TEST(Crown, HoldsAllOfTwoTreesAndOfARow) {
  expect_no_strays(leaves_at(joined(ball(500), ball(500, {40, 0, 0}))));
  std::vector<Vec3d> row;
  for (int i = 0; i < 12; ++i) row = joined(row, ball(100, {4. * i, 0, 0}));
  expect_no_strays(leaves_at(row));
}

// Most leaves of a spruce are near the ground, and its top is farther from them than strays may be.
TEST(Crown, HoldsALongTip) {
  std::vector<Vec3d> spruce;
  for (const Vec3d p : ball(2000)) {
    const double height = std::cbrt(std::fabs(p.y));
    spruce.push_back({p.x * (1 - height), 6 * height * height * height, p.z * (1 - height)});
  }
  spruce.push_back({0, 6, 0});
  expect_no_strays(leaves_at(spruce));
}

TEST(Crown, HoldsABranchThatReachesFarOut) {
  std::vector<Vec3d> places = ball(1000);
  for (int i = 0; i < 8; ++i) places.push_back({1.6 + 0.6 * i, 0, 0});
  expect_no_strays(leaves_at(places));
  for (int i = 0; i < 2; ++i) places.erase(places.begin() + 1001);
  EXPECT_EQ(find_crown(leaves_at(places)).strays, 5u);
}

TEST(Crown, EndsAtAGapWhereverTheCellsLie) {
  const std::vector<Vec3d> tree = ball(1000);
  const double length = 1.3;  // roughly that of the core
  for (int i = 0; i < 12; ++i) {
    const Vec3d twig(1.3 + 0.05 * i, 0, 0);
    expect_no_strays(leaves_at(joined(tree, {twig, twig + Vec3d(0.45 * length, 0, 0)})));
    expect_strays(joined(tree, {twig}), {twig + Vec3d(0.85 * length, 0, 0)});
  }
}

TEST(Crown, HoldsALeafThatComesNear) {
  LeafSet leaves = leaves_at(ball(1000));
  add_leaf(leaves, {5, 0, 0}, 2, 8);  // reaches from 1 to 9 along x
  expect_no_strays(leaves);
}

TEST(Crown, HasAnyExtent) {
  expect_no_strays(leaves_at(std::vector<Vec3d>(50, Vec3d(1, 2, 3))));
  LeafSet points = leaves_at(std::vector<Vec3d>(50, Vec3d(1, 2, 3)));
  points.bounds = {};
  for (LeafVertex& vertex : points.vertices) {
    vertex.position = {1, 2, 3};
    points.bounds.include(vertex.position);
  }
  expect_no_strays(points);

  std::vector<Vec3d> flat = ball(500);
  for (Vec3d& p : flat) p.z = 0;
  expect_no_strays(leaves_at(flat));
  expect_strays(flat, {{0, 0, 4}, {1e300, 0, 0}});
}

TEST(Crown, CountsALeafOnceHoweverFineItIs) {
  LeafSet coarse, fine;
  for (const Vec3d place : ball(200)) {
    add_leaf(coarse, place);
    add_leaf(fine, place);
  }
  for (const Vec3d place : ball(10, {0, 7, 0})) {
    add_leaf(coarse, place);
    add_leaf(fine, place, 20);  // more vertices than the tree has
  }
  const Crown a = find_crown(coarse), b = find_crown(fine);
  EXPECT_EQ(a.strays, 10u);
  EXPECT_EQ(b.strays, 10u);
  expect_box(b.box, a.box);
}

TEST(Crown, DoesNotDependOnTheOrderOfLeaves) {
  std::vector<Vec3d> places = joined(ball(300), ball(9, {-5, 5, 0}));
  for (int i = 0; i < 9; ++i) places.push_back({2 + 0.55 * i, 0.3, 0});
  const Crown crown = find_crown(leaves_at(places));
  EXPECT_GT(crown.strays, 0u);
  Random random(3);
  for (int i = 0; i < 10; ++i) {
    std::ranges::shuffle(places, random);
    const Crown again = find_crown(leaves_at(places));
    EXPECT_EQ(again.strays, crown.strays);
    EXPECT_EQ(again.farthest, crown.farthest);
    expect_box(again.box, crown.box);
  }
}

TEST(Crown, WarnsOfStrays) {
  const Box box{{0, 0, 0}, {1, 2, 1}};
  EXPECT_EQ(stray_warning({box, 20, 6.2}),
            "20 leaves lie far from the crown, up to 3.1 times the crown's longest side away; they "
            "do not count towards its size");
  EXPECT_EQ(stray_warning({box, 1, 3}),
            "1 leaf lies far from the crown, 1.5 times the crown's longest side away; it does not "
            "count towards its size");
}

TEST(Crown, IsFoundWithTheLeaves) {
  Primitive cards;
  for (const Vec3d place : joined(ball(100), {{0, -8, 0}})) {
    const Vec3f p(place);
    test::add_quad(cards,
                   {p, p + Vec3f(0.1f, 0, 0), p + Vec3f(0.1f, 0.1f, 0), p + Vec3f(0, 0.1f, 0)});
  }
  const LeafSet leaves = find_leaves(test::tree_of({cards}), {});
  EXPECT_EQ(leaves.leaf_count, 101u);
  EXPECT_EQ(leaves.stray_leaves, 1u);
  EXPECT_LT(leaves.bounds.low.y, -7.9);
  EXPECT_GT(leaves.crown.low.y, -1.1);
  EXPECT_EQ(leaves.crown.high, leaves.bounds.high);
  ASSERT_EQ(leaves.warnings.size(), 1u);
  EXPECT_NE(leaves.warnings[0].find("1 leaf lies far from the crown"), std::string::npos);
}

}  // namespace
}  // namespace leafhull
