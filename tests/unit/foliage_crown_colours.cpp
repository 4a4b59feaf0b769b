// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "colour/colour.h"
#include "foliage/crown_colours.h"
#include "foliage_models.h"

namespace leafhull {
namespace {

using namespace test;

constexpr Vec3f kRed{0.5f, 0.04f, 0.02f};
constexpr double kMass = 0.4;

/// Two balls of cards side by side in one primitive.
TreeModel pair_of(Vec3f left, Vec3f right) {
  return model_of(
      {{joined(coloured(cards({-2, 0, 0}, 1), left), coloured(cards({2, 0, 0}, 1), right)),
        {.name = "leaves"}}});
}

std::optional<CrownColours> colours_of(const TreeModel& tree, const LeafOptions& options = {}) {
  return CrownColours::of(tree, find_leaves(tree, options), kMass);
}

void expect_near(Vec3f a, Vec3f b, float distance) {
  EXPECT_LT(length(a - b), distance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(CrownColours, KeepTheirPlaces) {
  const auto colours = colours_of(pair_of(kRed, kGreen));
  ASSERT_TRUE(colours);
  expect_near(colours->at({-3, 0, 0}), kRed, 1e-3f);
  expect_near(colours->at({3, 0, 0}), kGreen, 1e-3f);
  expect_near(colours->at({-2, 1.2, 0}), kRed, 1e-3f);  // above the leaves, like a surface
  expect_near(colours->at({100, 0, 0}), (kRed + kGreen) / 2, 0.02f);
}

TEST(CrownColours, AreToldApartTheOneOfMostLeavesFirst) {
  const TreeModel tree =
      model_of({{coloured(cards({-2, 0, 0}, 1, 400), kGreen), {.name = "leaves"}},
                {coloured(cards({2, 0, 0}, 1, 200), kRed), {.name = "leaves"}}});
  const auto colours = colours_of(tree);
  ASSERT_TRUE(colours);
  ASSERT_EQ(colours->tones().size(), 2u);
  expect_near(colours->tones()[0], kGreen, 1e-2f);
  expect_near(colours->tones()[1], kRed, 1e-2f);
}

TEST(CrownColours, AreFourAtMost) {
  TreeModel tree = model_of({{cards({0, 0, 0}, 3, 600), {.name = "leaves"}}});
  Primitive& leaves = tree.primitives[0];
  for (const Vec3f p : leaves.positions) {
    const auto part = static_cast<int>((std::atan2(p.z, p.x) / M_PI + 1) * 2.999);
    constexpr Vec3f kWheel[] = {{0.5f, 0, 0},    {0.5f, 0.4f, 0}, {0, 0.4f, 0},
                                {0, 0.4f, 0.5f}, {0, 0, 0.5f},    {0.5f, 0, 0.5f}};
    leaves.colors.push_back(kWheel[part]);
  }
  const auto colours = colours_of(tree);
  ASSERT_TRUE(colours);
  EXPECT_EQ(colours->tones().size(), 4u);
}

TEST(CrownColours, OfOneColourAreNone) {
  EXPECT_FALSE(colours_of(pair_of(kGreen, kGreen)));
  EXPECT_FALSE(colours_of(pair_of(kGreen, kGreen * 0.5f))) << "one hue, in light and shade";
  EXPECT_FALSE(colours_of(model_of({{cards({0, 0, 0}, 1), {.name = "leaves"}}}))) << "none known";
  LeafOptions tinted;
  tinted.tint = Srgb{200, 40, 20};
  EXPECT_FALSE(colours_of(pair_of(kRed, kGreen), tinted));
}

TEST(CrownColours, ThatAreMixedLeafByLeafAreOne) {
  TreeModel tree = model_of({{cards({0, 0, 0}, 1, 2000, 0.02f), {.name = "leaves"}}});
  Primitive& leaves = tree.primitives[0];
  for (std::size_t i = 0; i < leaves.positions.size(); ++i) {
    leaves.colors.push_back(i / 4 % 2 ? kRed : kGreen);
  }
  EXPECT_FALSE(colours_of(tree));
}

TEST(CrownColours, OfALargeTriangleLieAllOverIt) {
  TreeModel tree = pair_of(kRed, kGreen);
  // The sheet has no vertices near its middle.
  Primitive sheet = coloured(ground(3, 2.2f), kRed);
  sheet.material = 0;
  tree.primitives.push_back(sheet);
  tree.instances.push_back({1, "", kIdentity});
  const auto colours = colours_of(tree);
  ASSERT_TRUE(colours);
  for (const Vec3d place : {Vec3d{2.5, 2.4, 2}, {-2, 2.4, -2.5}, {0, 2.4, 2}, {1, 2.4, -2}}) {
    expect_near(colours->at(place), kRed, 1e-3f);
  }
}

TEST(CrownColours, OfInstancesStandWhereTheyAre) {
  TreeModel tree = model_of({{coloured(cards({0, 0, 0}, 1), kRed), {.name = "leaves"}},
                             {coloured(cards({0, 0, 0}, 1), kGreen), {.name = "leaves"}}});
  tree.instances[0].to_world[0][3] = 5;
  const auto colours = colours_of(tree);
  ASSERT_TRUE(colours);
  expect_near(colours->at({5, 1, 0}), kRed, 1e-3f);
  expect_near(colours->at({0, 1, 0}), kGreen, 1e-3f);
}

}  // namespace
}  // namespace leafhull
