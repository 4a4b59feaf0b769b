// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "leafhull/error.h"
#include "render/camera.h"

namespace leafhull::render {
namespace {

void expect_near(Vec3f a, Vec3f b) {
  EXPECT_LT(length(a - b), 1e-5f) << a.x << ' ' << a.y << ' ' << a.z;
}

const std::vector<Vec3f> kPoints{{1, 0, 0.2f}, {-0.5f, 2, 0}, {0, 1, -0.7f}, {0.3f, 1.5f, 0.9f}};

/// The least distance of the points from the picture's border, as a share of its width or height.
float margin_of(const Camera& camera, std::span<const Vec3f> points) {
  float least = 1;
  for (const Vec3f point : points) {
    const Vec3f ray = point - camera.eye;
    const float depth = dot(ray, camera.forward);
    const float x = 0.5f + dot(ray, camera.right) / depth / camera.tan_x / 2;
    const float y = 0.5f - dot(ray, camera.up) / depth / camera.tan_y / 2;
    least = std::min({least, x, 1 - x, y, 1 - y});
  }
  return least;
}

TEST(RenderView, FrontLooksAlongMinusZ) {
  const Camera camera = frame(kPoints, 1, 0.1f, 0, kFront);
  expect_near(camera.forward, {0, 0, -1});
  expect_near(camera.right, {1, 0, 0});
  expect_near(camera.up, {0, 1, 0});
  EXPECT_GT(camera.eye.z, 1);
}

TEST(RenderView, TopLooksDown) {
  const Camera camera = frame(kPoints, 1, 0.1f, 0, kTop);
  expect_near(camera.forward, {0, -1, 0});
  expect_near(camera.right, {1, 0, 0});
  expect_near(camera.up, {0, 0, -1});
  EXPECT_GT(camera.eye.y, 2);
}

TEST(RenderView, EveryViewpointHoldsAllPointsWithTheMargin) {
  for (const Viewpoint viewpoint : {kFront, kThreeQuarter, kTop, Viewpoint{200, -30}}) {
    for (const float aspect : {0.5f, 1.0f, 2.0f}) {
      EXPECT_NEAR(margin_of(frame(kPoints, aspect, 0.1f, 0, viewpoint), kPoints), 0.1f, 1e-3f);
    }
  }
}

TEST(RenderView, ATurntableHoldsAllPointsAtEveryAngle) {
  for (const Viewpoint viewpoint : {kFront, kThreeQuarter, kTop}) {
    const Turntable table = turntable(kPoints, 1.5f, 0.1f, 0, viewpoint);
    float least = 1;
    for (int degree = 0; degree < 360; ++degree) {
      least = std::min(least, margin_of(table.at(degree), kPoints));
    }
    EXPECT_NEAR(least, 0.1f, 1e-3f)
        << viewpoint.elevation;  // the subject is no smaller than needed
  }
}

TEST(RenderView, ATurntableTurnsRigidlyAboutItsAxis) {
  const Turntable table = turntable(kPoints, 1, 0.1f, 0, kFront);
  expect_near(table.axis, {0.25f, 1, 0.1f});  // the middle of the points' box
  expect_near(table.at(0).eye, table.camera.eye);
  expect_near(table.at(90).forward, {-1, 0, 0});
  expect_near(table.at(90).right, {0, 0, -1});
  expect_near(table.at(180).forward, {0, 0, 1});
  const float distance = length(table.camera.eye - table.axis);
  for (const double degrees : {10.0, 90.0, 205.0}) {
    const Camera camera = table.at(degrees);
    EXPECT_NEAR(length(camera.eye - table.axis), distance, 1e-4f);
    EXPECT_EQ(camera.eye.y, table.camera.eye.y);
    EXPECT_EQ(camera.tan_x, table.camera.tan_x);
    expect_near(camera.up, {0, 1, 0});
  }
}

TEST(RenderView, AWholeTurnIsTheSameCamera) {
  const Turntable table = turntable(kPoints, 1);
  const Camera before = table.at(0), after = table.at(360);
  EXPECT_EQ(before.eye, after.eye);
  EXPECT_EQ(before.forward, after.forward);
  EXPECT_EQ(before.right, after.right);
  EXPECT_EQ(table.at(30).eye, table.at(390).eye);
}

TEST(RenderView, ACameraByHand) {
  const Camera camera = look_at({10, 2, 3}, {4, 2, 3}, {1, 5, 0}, 90, 2, Placement{{4, 0, 3}, 0.5});
  expect_near(camera.eye, {3, 1, 0});
  expect_near(camera.forward, {-1, 0, 0});
  expect_near(camera.up, {0, 1, 0});
  expect_near(camera.right, {0, 0, -1});
  EXPECT_FLOAT_EQ(camera.tan_x, 1);
  EXPECT_FLOAT_EQ(camera.tan_y, 0.5f);
  EXPECT_FLOAT_EQ(look_at({0, 0, 1}, {}, {0, 1, 0}, 90, 0.5f).tan_y, 1);
}

TEST(RenderView, CamerasThatSeeNothingAreRefused) {
  EXPECT_THROW(look_at({1, 2, 3}, {1, 2, 3}, {0, 1, 0}, 40, 1), Error);
  EXPECT_THROW(look_at({0, 5, 0}, {0, 0, 0}, {0, 1, 0}, 40, 1), Error);
  EXPECT_THROW(look_at({0, 5, 0}, {0, 0, 0}, {0, 0, 0}, 40, 1), Error);
  for (const double angle : {0.0, -3.0, 180.0, std::nan("")}) {
    EXPECT_THROW(look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, angle, 1), Error) << angle;
  }
}

}  // namespace
}  // namespace leafhull::render
