// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>

#include "leafhull/error.h"
#include "leafhull/picture.h"
#include "render/camera.h"
#include "render_meshes.h"
#include "render_pixels.h"

namespace leafhull {
namespace {

/// The corners of a cube.
Frame cube(double half, Vec3d centre = {}) {
  Frame frame;
  for (int i = 0; i < 8; ++i) {
    const Vec3d corner{i & 4 ? half : -half, i & 2 ? half : -half, i & 1 ? half : -half};
    frame.points.push_back(centre + corner);
  }
  return frame;
}

TEST(RenderCamera, HoldsTheBoxWithItsMargin) {
  std::vector<Vec3f> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? 3.0f : -1.0f, i & 2 ? 5.0f : 0.0f, i & 4 ? 2.0f : 1.0f);
  }
  for (const float aspect : {0.5f, 1.0f, 2.0f}) {
    const render::Camera camera = render::frame(corners, aspect, 0.1f);
    float least = 1, most = 0;
    for (const Vec3f corner : corners) {
      const Vec3f ray = corner - camera.eye;
      const float depth = dot(ray, camera.forward);
      const float x = 0.5f + dot(ray, camera.right) / depth / camera.tan_x / 2;
      const float y = 0.5f - dot(ray, camera.up) / depth / camera.tan_y / 2;
      least = std::min({least, x, y}), most = std::max({most, x, y});
    }
    EXPECT_NEAR(least, 0.1f, 1e-3f) << aspect;
    EXPECT_NEAR(most, 0.9f, 1e-3f) << aspect;
  }
}

TEST(RenderShape, AnEmptyMeshIsWhitePaper) {
  const Picture picture = draw_shape({}, {}, 7, 5);
  EXPECT_EQ(picture.width, 7);
  EXPECT_EQ(picture.height, 5);
  EXPECT_EQ(picture.rgb, std::vector<std::uint8_t>(3 * 7 * 5, 255));
}

TEST(RenderShape, RefusesPicturesOfNothing) {
  EXPECT_THROW(draw_shape({}, cube(1), 0, 5), Error);
  EXPECT_THROW(draw_shape(sphere({}, 1), {}, 5, 5), Error);
}

TEST(RenderShape, ASphereIsRoundAndLitFromTheUpperLeft) {
  constexpr int kSize = 120;
  const Picture picture = draw_shape(sphere({}, 1), cube(1), kSize, kSize);
  // The sphere fills a square in the middle; the rest is white.
  const Rectangle ink = ink_of(picture);
  EXPECT_NEAR(ink.right - ink.left, ink.bottom - ink.top, 1);
  EXPECT_NEAR((ink.left + ink.right) / 2, kSize / 2, 6);
  EXPECT_NEAR((ink.top + ink.bottom) / 2, kSize / 2, 6);
  EXPECT_GT(ink.right - ink.left, kSize / 2);
  const double radius = (ink.right - ink.left) / 2.0, x = kSize / 2.0,
               y = (ink.top + ink.bottom) / 2.0;
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const double distance = std::hypot(column + 0.5 - x, row + 0.5 - y);
      const bool paper = grey(picture, column, row) == 255;
      if (std::abs(distance - radius) > 2) {
        EXPECT_EQ(paper, distance > radius) << column << ' ' << row;
      }
    }
  }
  const auto at = [&](double dx, double dy) {
    return grey(picture, static_cast<int>(x + dx * radius), static_cast<int>(y + dy * radius));
  };
  EXPECT_GT(at(-0.5, -0.5), at(0.5, 0.5) + 40);
  EXPECT_GT(at(-0.5, 0), at(0.5, 0));
  EXPECT_GT(at(0, -0.6), at(0, 0.6));
}

TEST(RenderShape, ShadowsFallToTheLowerRight) {
  Mesh mesh = sphere({}, 1);
  const auto lit = [&](const Mesh& shape) { return draw_shape(shape, cube(3), 120, 120); };
  const Picture alone = lit(mesh);
  // The sphere is towards this camera's sun, at the upper left in front.
  const Mesh other = sphere({-1.1f, 2.1f, 1.5f}, 0.6f);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({a + first, b + first, c + first});
  }
  const Picture shaded = lit(mesh);
  int darker = 0;
  const Rectangle ink = ink_of(alone);
  for (int y = ink.top; y < ink.bottom; ++y) {
    for (int x = ink.left; x < ink.right; ++x) {
      darker += grey(shaded, x, y) < grey(alone, x, y) - 30;
    }
  }
  EXPECT_GT(darker, 20);
}

TEST(RenderShape, OneFrameIsOneCamera) {
  const Rectangle small = ink_of(draw_shape(sphere({}, 0.5f), cube(1), 120, 120));
  const Rectangle large = ink_of(draw_shape(sphere({}, 1), cube(1), 120, 120));
  EXPECT_NEAR(2 * (small.right - small.left), large.right - large.left, 3);
}

TEST(RenderShape, AFrameHoldsBallsAroundItsPoints) {
  constexpr int kSize = 200, kMargin = 12;
  const Frame point{{{5, 6, 7}}, 2};
  const Rectangle ball = ink_of(draw_shape(sphere({5, 6, 7}, 2), point, kSize, kSize));
  for (const int edge : {ball.left, ball.top, kSize - ball.right, kSize - ball.bottom}) {
    EXPECT_GT(edge, 0);
    EXPECT_LT(edge, 2 * kMargin);
  }
}

TEST(RenderShape, FarFromTheOriginItIsTheSame) {
  Mesh mesh = sphere({}, 1);
  const Picture near = draw_shape(mesh, cube(1), 60, 60);
  mesh.origin = {4e6, -2e6, 8e6};
  EXPECT_EQ(near.rgb, draw_shape(mesh, cube(1, mesh.origin), 60, 60).rgb);
}

TEST(RenderShape, IsTheSameWithAnyNumberOfThreads) {
  const Mesh mesh = sphere({}, 1);
  const Picture many = draw_shape(mesh, cube(1), 90, 70);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many.rgb, draw_shape(mesh, cube(1), 90, 70).rgb);
}

}  // namespace
}  // namespace leafhull
