// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "colour/colour.h"
#include "render/light.h"
#include "render/shade.h"
#include "render_pixels.h"

namespace leafhull::render {
namespace {

constexpr Vec3f kRight{1, 0, 0}, kUp{0, 1, 0}, kTowardsEye{0, 0, 1};
const Camera kCamera{{0, 0, 5}, kRight, kUp, -kTowardsEye, 0.1f, 0.1f};

/// A row with one pixel of paper, then green pixels at the origin that face the eye and the light.
Buffers row(int count) {
  Buffers buffers;
  buffers.resize(1 + count, 1);
  buffers.eye = kCamera.eye;
  buffers.to_light = buffers.to_eye = kTowardsEye;
  for (int i = 1; i <= count; ++i) {
    buffers.object[i] = Object::foliage;
    buffers.depth[i] = 5;
    buffers.normal[i] = kTowardsEye;
    buffers.color[i] = {0.2f, 0.4f, 0.1f};
  }
  return buffers;
}

std::array<int, 3> pixel(const Picture& picture, int x) {
  return {picture.rgb[3 * x], picture.rgb[3 * x + 1], picture.rgb[3 * x + 2]};
}

TEST(RenderPhong, LightShadowAndSkyTellInTurn) {
  Buffers buffers = row(4);
  buffers.key[2] = 0;
  buffers.open[3] = 0;
  buffers.key[4] = buffers.open[4] = 0;
  const Picture picture = shade_phong(buffers);
  EXPECT_EQ(grey(picture, 0, 0), 255) << "paper";
  EXPECT_GT(grey(picture, 1, 0), grey(picture, 2, 0) + 30);
  EXPECT_GT(grey(picture, 1, 0), grey(picture, 3, 0) + 2);
  EXPECT_GT(grey(picture, 2, 0), grey(picture, 4, 0) + 20);
  EXPECT_GT(grey(picture, 4, 0), 30) << "no black";
  for (int x = 1; x <= 4; ++x) {
    const auto [r, g, b] = pixel(picture, x);
    EXPECT_GT(g, r);
    EXPECT_GT(g, b);
  }
}

TEST(RenderPhong, TheHighlightLiesInTheMirrorDirection) {
  Buffers buffers = row(3);
  buffers.to_light = kRight;
  buffers.normal[1] = normalized(kRight + kTowardsEye);  // halfway between light and eye
  buffers.normal[2] = normalized(kRight * 0.4f + kTowardsEye);
  buffers.normal[3] = -kRight;
  const Picture phong = shade_phong(buffers), matte = shade_matte(buffers);
  EXPECT_GT(grey(phong, 1, 0), grey(matte, 1, 0) + 10);
  EXPECT_NEAR(grey(phong, 2, 0), grey(matte, 2, 0), 3);
  EXPECT_EQ(grey(phong, 3, 0), grey(matte, 3, 0));
  buffers.key[1] = 0;
  EXPECT_EQ(grey(shade_phong(buffers), 1, 0), grey(shade_matte(buffers), 1, 0));
}

TEST(RenderPhong, AnEdgeIsTheMeanOfWhatItsRaysSee) {
  Buffers buffers = row(2);
  buffers.edges = {1};
  buffers.edge_rays = 3;
  const EdgeSample green{Object::foliage, 5, kTowardsEye, {}, buffers.color[1], 1, 1};
  buffers.samples = {EdgeSample{}, green, EdgeSample{}};
  const Picture picture = shade_phong(buffers);
  const auto edge = pixel(picture, 1), whole = pixel(picture, 2);
  for (int i = 0; i < 3; ++i) {
    const float half = (1 + linear_of_srgb(static_cast<std::uint8_t>(whole[i]))) / 2;
    EXPECT_NEAR(edge[i], srgb(half), 1);
  }
}

TEST(RenderNormals, AreColoursInTheCamerasSpace) {
  Buffers buffers = row(4);
  buffers.normal[1] = kRight;
  buffers.normal[2] = kUp;
  buffers.normal[3] = kTowardsEye;
  buffers.normal[4] = -kRight;
  const Picture picture = shade_normals(buffers, kCamera);
  EXPECT_EQ(pixel(picture, 0), (std::array{128, 128, 128}));
  EXPECT_EQ(pixel(picture, 1), (std::array{255, 128, 128}));
  EXPECT_EQ(pixel(picture, 2), (std::array{128, 255, 128}));
  EXPECT_EQ(pixel(picture, 3), (std::array{128, 128, 255}));
  EXPECT_EQ(pixel(picture, 4), (std::array{0, 128, 128}));
}

TEST(RenderDepth, GoesFromWhiteToDark) {
  Buffers buffers = row(3);
  buffers.depth[1] = 3, buffers.depth[2] = 4, buffers.depth[3] = 5;
  const Picture picture = shade_depth(buffers);
  EXPECT_EQ(pixel(picture, 0), (std::array{0, 0, 0}));
  EXPECT_EQ(pixel(picture, 1), (std::array{255, 255, 255}));
  EXPECT_EQ(pixel(picture, 2), (std::array{153, 153, 153}));
  EXPECT_EQ(pixel(picture, 3), (std::array{51, 51, 51}));
}

TEST(RenderDepth, OfASubjectWithoutDepthIsWhite) {
  EXPECT_EQ(pixel(shade_depth(row(1)), 1), (std::array{255, 255, 255}));
  EXPECT_EQ(pixel(shade_depth(row(0)), 0), (std::array{0, 0, 0}));
}

}  // namespace
}  // namespace leafhull::render
