// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "colour/colour.h"
#include "watercolour/things.h"

namespace leafhull::watercolour {
namespace {

constexpr Vec3f kBark{0.12f, 0.06f, 0.03f}, kGrey{0.3f, 0.3f, 0.3f}, kLake{0.05f, 0.2f, 0.5f},
    kLawn{0.2f, 0.5f, 0.1f};

/// A row of wood pixels with these colours.
render::Buffers row_of(const std::vector<Vec3f>& colours) {
  render::Buffers buffers;
  buffers.resize(static_cast<int>(colours.size()), 1);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    buffers.object[i] = render::Object::wood;
    buffers.wood[i] = 1;
    buffers.color[i] = colours[i];
  }
  return buffers;
}

TEST(Things, HaveTheirOwnHueUnlessTheyAreBrownOrGrey) {
  const std::vector<Thing> things = things_of(row_of({kBark, kLake, kGrey, kLawn, kLake}));
  ASSERT_EQ(things.size(), 3u);
  EXPECT_FALSE(things[0].colour);
  EXPECT_EQ(things[0].coverage, (std::vector<float>{1, 0, 1, 0, 0}));
  EXPECT_EQ(things[1].coverage, (std::vector<float>{0, 0, 0, 1, 0}));
  EXPECT_LT(length(*things[1].colour - kLawn), 1e-6f);
  EXPECT_EQ(things[2].coverage, (std::vector<float>{0, 1, 0, 0, 1}));
  EXPECT_LT(length(*things[2].colour - kLake), 1e-6f);
}

TEST(Things, HaveTheColourOfANeighbourAtTheirEdges) {
  render::Buffers buffers = row_of({kLake, kLake, kLake});
  buffers.object[2] = render::Object::paper;
  buffers.color[2] = {};
  buffers.wood[2] = 0.25f;
  const std::vector<Thing> things = things_of(buffers);
  ASSERT_EQ(things.size(), 2u);
  EXPECT_EQ(things[1].coverage, (std::vector<float>{1, 1, 0.25f}));
}

TEST(Things, WoodAloneIsOneThing) {
  const std::vector<Thing> things = things_of(row_of({kBark, kGrey}));
  ASSERT_EQ(things.size(), 1u);
  EXPECT_EQ(things_of(row_of({})).size(), 1u);
}

TEST(Things, AWashInTheirHueIsAsLightAsBefore) {
  const Wash wood = shipped_style("classic").wood, blue = hued(wood, kLake);
  EXPECT_GT(blue.cool.z, blue.cool.x + 0.1f);
  EXPECT_EQ(blue.level, wood.level);
  const auto lightness = [](Vec3f srgb) {
    return oklab_of(Vec3f(Vec3d(linear_of_srgb(double{srgb.x}), linear_of_srgb(double{srgb.y}),
                                linear_of_srgb(double{srgb.z}))))
        .x;
  };
  EXPECT_NEAR(lightness(blue.warm), lightness(wood.warm), 0.01);
  EXPECT_EQ(hued(wood, {}).cool, wood.cool);
}

}  // namespace
}  // namespace leafhull::watercolour
