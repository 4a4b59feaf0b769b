// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "watercolour/strokes.h"

namespace leafhull::watercolour {
namespace {

constexpr int kSize = 64;

/// A picture that is half covered by foliage and dark everywhere.
struct Scene {
  std::vector<float> outline = std::vector<float>(kSize * kSize, 0.5f);
  std::vector<float> dark = std::vector<float>(kSize * kSize, 0.9f);
  std::vector<float> depth = std::vector<float>(kSize * kSize, 2.0f);
  Room room() const { return {kSize, kSize, outline, dark, depth}; }
};

Stroke leaf_at(float x, float y, std::uint32_t leaf = 0) {
  return {{x, y}, {8, 0}, {0, 4}, 2, leaf};
}

double sum(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

constexpr Brush kBrush{.size = 1, .least = 1, .most = 20, .tolerance = 0.1f};

TEST(Strokes, ALeafHasItsShape) {
  const Scene scene;
  const std::vector<float> v = break_edges({{leaf_at(32, 32)}}, scene.room(), kBrush);
  const auto at = [&](int x, int y) { return std::abs(v[y * kSize + x]); };
  EXPECT_GT(at(32, 32), 0.39f);       // the gain is 0.4 to 1
  EXPECT_EQ(at(32, 32), at(37, 32));  // along the leaf
  EXPECT_EQ(at(32, 37), 0);           // half as wide as long
  EXPECT_EQ(at(41, 32), 0);           // beyond the tip
  EXPECT_EQ(at(38, 35), 0);           // it narrows
  // The outline is two parabolas over 16 pixels, 4 high.
  EXPECT_NEAR(sum(v) / v[32 * kSize + 32], 2 * 2 / 3.0 * 16 * 4, 3);
}

TEST(Strokes, LeavesAddOrTakeByTheirHash) {
  const Scene scene;
  int adding = 0;
  for (std::uint32_t leaf = 0; leaf < 200; ++leaf) {
    const std::vector<float> v = break_edges({{leaf_at(32, 32, leaf)}}, scene.room(), kBrush);
    adding += v[32 * kSize + 32] > 0;
  }
  EXPECT_GT(adding, 70);
  EXPECT_LT(adding, 130);
}

TEST(Strokes, AHiddenLeafAndOneOutsideAreNotPainted) {
  Scene scene;
  std::fill(scene.depth.begin(), scene.depth.end(), 1.5f);
  EXPECT_EQ(sum(break_edges({{leaf_at(32, 32)}}, scene.room(), kBrush)), 0);
  for (const Vec2f at : {Vec2f{-1, 3}, {3, -1}, {64, 3}, {3, 64}, {NAN, 3}, {1e30f, 3}}) {
    EXPECT_EQ(sum(break_edges({{leaf_at(at.x, at.y)}}, Scene().room(), kBrush)), 0);
  }
}

TEST(Strokes, StrokesKeepToTheBrush) {
  const Scene scene;
  const auto area = [&](Vec2f major, Vec2f minor, const Brush& brush) {
    const Stroke stroke{{32, 32}, major, minor, 2, 3};
    const std::vector<float> v = break_edges({{stroke}}, scene.room(), brush);
    return std::count_if(v.begin(), v.end(), [](float x) { return x != 0; });
  };
  const Brush brush{.size = 1, .least = 4, .most = 6, .tolerance = 0.1f};
  EXPECT_GT(area({0.1f, 0}, {0, 0.05f}, brush), 10);  // not smaller than the least size
  EXPECT_GT(area({5, 0}, {0, 0.01f}, brush), 15);     // not thin even when seen from its edge
  EXPECT_GT(area({20, 0}, {0, 20}, brush), 3 * area({6, 0}, {0, 4}, brush));  // a spray
  EXPECT_EQ(area({0, 0}, {0, 0}, brush), 0);
}

TEST(Strokes, NeedlesFanOutFromOnePoint) {
  const Scene scene;
  Brush brush = kBrush;
  brush.mark = Mark::tuft;
  const std::vector<float> v = break_edges({{leaf_at(32, 32)}}, scene.room(), brush);
  const auto runs = [&](int x) {
    int count = 0;
    for (int y = 1; y < kSize; ++y) count += v[y * kSize + x] != 0 && v[(y - 1) * kSize + x] == 0;
    return count;
  };
  EXPECT_EQ(runs(24), 1) << "their common foot is at the left";
  EXPECT_EQ(runs(37), 3);
  EXPECT_LT(sum(v) / v[32 * kSize + 32], 3 * 2 * 2 / 3.0 * 21 * 2) << "and they are thin";
}

TEST(Strokes, AFrondIsLongAndSlender) {
  const Scene scene;
  Brush brush = kBrush;
  brush.mark = Mark::blade;
  const std::vector<float> v = break_edges({{leaf_at(32, 32)}}, scene.room(), brush);
  const auto at = [&](int x, int y) { return std::abs(v[y * kSize + x]); };
  EXPECT_GT(at(32, 32), 0);
  EXPECT_GT(at(46, 32), 0) << "twice as long as its card";
  EXPECT_EQ(at(32, 38), 0);
  // A large card becomes a spray of strokes, roughly along the card.
  const Stroke card{{32, 32}, {20, 0}, {0, 20}, 2, 3};
  brush.most = 4;
  const std::vector<float> spray = break_edges({{card}}, scene.room(), brush);
  double along = 0, across = 0;
  for (int y = 1; y < kSize; ++y) {
    for (int x = 1; x < kSize; ++x) {
      along += std::abs(spray[y * kSize + x] - spray[y * kSize + x - 1]);
      across += std::abs(spray[y * kSize + x] - spray[(y - 1) * kSize + x]);
    }
  }
  EXPECT_GT(across, 1.5 * along);
}

TEST(Strokes, ALeafAtTheEyeIsASprayOfBoundedLength) {
  const Scene scene;
  const auto area = [&](float half, float size) {
    const Stroke stroke{{32, 32}, {half, 0}, {0, half}, 2, 3};
    const Brush brush{.size = size, .least = 1, .most = 3, .tolerance = 0.1f};
    const std::vector<float> v = break_edges({{stroke}}, scene.room(), brush);
    return std::count_if(v.begin(), v.end(), [](float x) { return x != 0; });
  };
  // To cover it would take 2e1 dabs, 2e13, and more than floats can count.
  const auto few = area(20, 1);
  EXPECT_GT(few, 100);
  EXPECT_EQ(area(20, 1e6f), few);
  EXPECT_EQ(area(20, 1e30f), few);
  EXPECT_EQ(area(1e30f, 1), 0) << "each beside the picture";
}

TEST(Strokes, SingleLeavesStandAtTheEdgeAndInTheLight) {
  std::vector<Stroke> leaves;
  for (std::uint32_t i = 0; i < 400; ++i) leaves.push_back(leaf_at(32, 32, i));
  const auto painted = [&](float outline, float dark, float detail) {
    Scene scene;
    std::fill(scene.outline.begin(), scene.outline.end(), outline);
    std::fill(scene.dark.begin(), scene.dark.end(), dark);
    int count = 0;
    for (const Stroke& leaf : leaves)
      count += sum(paint_leaves({{leaf}}, scene.room(), kBrush, detail)) > 0;
    return count;
  };
  EXPECT_EQ(painted(1, 1, 0.5f), 0);   // deep in the shadow
  EXPECT_GT(painted(1, 0, 0.5f), 30);  // in the light
  EXPECT_GT(painted(0.3f, 1, 0.5f), 2 * painted(1, 0, 0.5f));
  EXPECT_GT(painted(0.3f, 1, 1), painted(0.3f, 1, 0.5f));
  EXPECT_EQ(painted(0.3f, 1, 0), 0);
  EXPECT_EQ(painted(0, 0, 1), 0);  // far from the crown
}

TEST(Strokes, TheSameLeavesWhereverTheyAre) {
  const Scene scene;
  for (std::uint32_t leaf = 0; leaf < 50; ++leaf) {
    const auto here = paint_leaves({{leaf_at(20.5f, 20.5f, leaf)}}, scene.room(), kBrush, 0.5f);
    const auto there = paint_leaves({{leaf_at(40.5f, 41.5f, leaf)}}, scene.room(), kBrush, 0.5f);
    EXPECT_EQ(here[20 * kSize + 20], there[41 * kSize + 40]) << leaf;
  }
}

TEST(Strokes, TheOrderOfLeavesDoesNotMatterToWhatTheyCover) {
  const Scene scene;
  std::vector<Stroke> leaves;
  for (std::uint32_t i = 0; i < 60; ++i) {
    leaves.push_back(leaf_at(10.0f + static_cast<float>(i * 7 % 40),
                             10.0f + static_cast<float>(i * 11 % 40), i));
  }
  const auto covered = paint_leaves(leaves, scene.room(), kBrush, 1);
  std::reverse(leaves.begin(), leaves.end());
  EXPECT_EQ(covered, paint_leaves(leaves, scene.room(), kBrush, 1));
}

}  // namespace
}  // namespace leafhull::watercolour
