// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "leafhull/error.h"
#include "leaves/sheets.h"
#include "leaves_models.h"
#include "points/leaf_points.h"
#include "unit/points_measures.h"

namespace leafhull {
namespace {

using test::area_of;
using test::layers_at;

LeafPoints area_points(const LeafSet& leaves, double spacing) {
  return leafhull::area_points(leaves, spacing, 3 * spacing);
}

using test::card;
using test::masked;
using test::tree_of;

LeafSet leaves_of(const TreeModel& tree) { return find_leaves(tree, {}); }

/// Cuts every triangle into four at the midpoints of its sides.
Primitive quartered(const Primitive& whole) {
  Primitive fine;
  for (const auto& triangle : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(fine.positions.size());
    for (std::uint32_t i = 0; i < 3; ++i) {
      fine.positions.push_back(whole.positions[triangle[i]]);
      if (!whole.uvs.empty()) fine.uvs.push_back(whole.uvs[triangle[i]]);
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t a = first + i, b = first + (i + 1) % 3;
      fine.positions.push_back((fine.positions[a] + fine.positions[b]) * 0.5f);
      if (!whole.uvs.empty()) {
        fine.uvs.push_back(
            {(fine.uvs[a].x + fine.uvs[b].x) / 2, (fine.uvs[a].y + fine.uvs[b].y) / 2});
      }
    }
    fine.triangles.push_back({first, first + 3, first + 5});
    fine.triangles.push_back({first + 3, first + 1, first + 4});
    fine.triangles.push_back({first + 5, first + 4, first + 2});
    fine.triangles.push_back({first + 3, first + 4, first + 5});
  }
  return fine;
}

TEST(LeafPoints, CountAndKeepTheAreaOfACard) {
  const LeafSet leaves = leaves_of(tree_of({card(10, 7)}));
  EXPECT_NEAR(leaves.area, 70, 1e-9);
  const LeafPoints points = area_points(leaves, 1);
  EXPECT_EQ(points.points.size(), 70u);
  EXPECT_NEAR(area_of(points.points), 70, 1e-6);
}

TEST(LeafPoints, AreaIsThatOfTheMaskTexelByTexel) {
  const Image image = test::alpha_image(32, test::opaque_inside(0.4, 0.6, 0.3, 0.35));
  std::size_t kept = 0;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) kept += image.rgba[i] >= 128;
  const double area = 6.0 * 4.0 * static_cast<double>(kept) / (32 * 32);
  const LeafSet whole = leaves_of(masked(tree_of({card(6, 4)}), image));
  EXPECT_NEAR(whole.area, area, 1e-9 * area);
  EXPECT_NEAR(area_of(area_points(whole, 0.3).points), area, 1e-6 * area);
  // Triangles that cut through texels have the same area together.
  const LeafSet fine = leaves_of(masked(tree_of({quartered(quartered(card(6, 4)))}), image));
  EXPECT_NEAR(fine.area, area, 1e-6 * area);
}

TEST(LeafPoints, FrontAndBackOfALeafCountOnce) {
  Primitive both = card(3, 2);
  test::add_back_faces(both);
  EXPECT_NEAR(leaves_of(tree_of({both})).area, 6, 1e-9);
  // The back may be cut along the other diagonal.
  Primitive crossed = card(3, 2);
  crossed.triangles.push_back({1, 0, 3});
  crossed.triangles.push_back({1, 3, 2});
  EXPECT_NEAR(leaves_of(tree_of({crossed})).area, 6, 1e-9);
}

TEST(LeafPoints, LieEvenlyOnAFlatSheet) {
  const double spacing = 1, radius = kLeastRadius * spacing;
  for (const auto& [width, height] : {std::pair(17.3f, 17.3f), {23.0f, 11.7f}, {31.0f, 9.2f}}) {
    const LeafPoints points = area_points(leaves_of(tree_of({card(width, height)})), spacing);
    double low = HUGE_VAL, high = 0;
    for (double x = -width / 2.0 + radius; x <= width / 2.0 - radius; x += 0.13) {
      for (double y = -height / 2.0 + radius; y <= height / 2.0 - radius; y += 0.13) {
        const double n = layers_at(points.points, {x, y, 0}, radius);
        low = std::min(low, n);
        high = std::max(high, n);
      }
    }
    EXPECT_GT(low, 0.97) << width << " x " << height;
    EXPECT_LT(high, 1.03) << width << " x " << height;
  }
}

TEST(LeafPoints, OfACutLeafHaveNoSmallRadiusInItsPlane) {
  for (const LeafPoint& point : area_points(leaves_of(tree_of({card(10, 7)})), 1).points) {
    EXPECT_GE(point.radius_minor, 2.5f);
    EXPECT_NEAR(std::fabs(point.normal.z), 1, 1e-6);
  }
}

TEST(LeafPoints, OfALeafThatIsOnePartKeepsItsEllipse) {
  const LeafSet leaves = leaves_of(tree_of({card(0.9f, 0.6f)}));
  const LeafPoints points = area_points(leaves, 1);
  ASSERT_EQ(points.points.size(), 1u);
  EXPECT_EQ(points.points[0].radius_major, leaves.vertices[0].radius_major);
  EXPECT_EQ(points.points[0].radius_minor, leaves.vertices[0].radius_minor);
  EXPECT_NEAR(length(points.points[0].position), 0, 1e-6);
}

TEST(LeafPoints, AreAlikeOnAlikeLeaves) {
  TreeModel tree = tree_of({card(5, 4)});
  Instance far = tree.instances[0];
  far.to_world = {{{0, -1, 0, 100}, {1, 0, 0, 40}, {0, 0, 1, 7}}};  // a quarter turn
  tree.instances.push_back(far);
  const LeafPoints points = area_points(leaves_of(tree), 1);
  ASSERT_EQ(points.points.size(), 40u);
  for (const LeafPoint& p : points.points) {
    if (p.position.x > 50) continue;
    const Vec3d there(100 - p.position.y, 40 + p.position.x, 7);
    EXPECT_TRUE(std::ranges::any_of(points.points, [&](const LeafPoint& q) {
      return length(q.position - there) < 1e-6 && std::abs(p.area - q.area) < 1e-9;
    }));
  }
}

TEST(LeafPoints, DoNotDependOnHowALeafIsTessellated) {
  const Image image = test::alpha_image(64, test::opaque_inside(0.5, 0.5, 0.45, 0.3));
  const Primitive coarse = card(9, 8);
  const LeafPoints a = area_points(leaves_of(masked(tree_of({coarse}), image)), 1);
  const LeafPoints b = area_points(leaves_of(masked(tree_of({quartered(coarse)}), image)), 1);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (const LeafPoint& p : a.points) {
    double nearest = HUGE_VAL;
    for (const LeafPoint& q : b.points)
      nearest = std::min(nearest, length(p.position - q.position));
    EXPECT_LT(nearest, 0.05);
  }
}

TEST(LeafPoints, OfManyNeedlesAreBoundedByTheirVolume) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> in(0, 6);
  Primitive needles;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const Vec3f p(in(random), in(random), in(random));
    needles.positions.insert(needles.positions.end(),
                             {p, p + Vec3f(0.2f, 0, 0), p + Vec3f(0, 0.02f, 0.01f)});
    needles.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const LeafSet leaves = leaves_of(tree_of({needles}));
  const LeafPoints points = area_points(leaves, 1);
  EXPECT_LE(points.points.size(), 7u * 7 * 7);
  EXPECT_NEAR(area_of(points.points), leaves.area, 1e-9 * leaves.area);
  // Joining keeps the centre of all points.
  Vec3d centre, expected;
  for (const LeafPoint& p : points.points) centre = centre + p.position * p.area;
  for (const LeafSheet& sheet : leaves.sheets->sheets) {
    expected = expected + sheet.at(leaves.sheets->charts[sheet.chart].centre) * sheet.area;
  }
  EXPECT_LT(length(centre - expected) / leaves.area, 1e-6);
}

TEST(LeafPoints, DoNotDependOnTheOrderOfTheFile) {
  std::vector<Primitive> cards;
  for (int i = 0; i < 9; ++i) {
    Primitive one = card(1.0f + 0.2f * static_cast<float>(i), 1);
    for (Vec3f& p : one.positions) p = p + Vec3f(2.0f * static_cast<float>(i % 3), 0.3f, i / 3.0f);
    cards.push_back(one);
  }
  const LeafPoints a = area_points(leaves_of(tree_of(cards)), 0.7);
  std::ranges::reverse(cards);
  const LeafPoints b = area_points(leaves_of(tree_of(cards)), 0.7);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].position, b.points[i].position);
    EXPECT_EQ(a.points[i].area, b.points[i].area);
  }
  EXPECT_EQ(a.samples, b.samples);
}

TEST(LeafPoints, SamplesStandForEqualShares) {
  const Image image = test::alpha_image(64, test::opaque_inside(0.5, 0.5, 0.25, 0.25));
  Primitive far = card(2, 2);  // a third of the visible area, as the mask is on both cards
  for (Vec3f& p : far.positions) p = p + Vec3f(10, 0, 0);
  const LeafSet leaves =
      leaves_of(masked(tree_of({card(2 * std::numbers::sqrt2_v<float>, 2), far}), image));
  const LeafPoints points = area_points(leaves, 0.5);
  const auto beyond = std::ranges::count_if(points.samples, [](Vec3d p) { return p.x > 5; });
  EXPECT_NEAR(static_cast<double>(beyond) / static_cast<double>(points.samples.size()),
              1 / (1 + std::numbers::sqrt2), 1e-3);
  for (const Vec3d& p : points.samples) {
    EXPECT_LT(std::hypot((p.x > 5 ? (p.x - 10) / 2 : p.x / (2 * std::numbers::sqrt2)), p.y / 2),
              0.27);
  }
}

TEST(LeafPoints, RefuseWhatCannotBe) {
  const LeafSet leaves = leaves_of(tree_of({card(10, 7)}));
  EXPECT_THROW(area_points(leaves, 1e-3), Error);  // 70 million
  LeafSet by_hand;
  by_hand.vertices.push_back({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1, 1, 0});
  EXPECT_THROW(area_points(by_hand, 1), Error);
}

TEST(LeafPoints, OfATextureThatHidesALeafLeaveItOut) {
  Primitive hidden = card(2, 2);
  for (Vec2f& uv : hidden.uvs) uv = {0.01f + 0.02f * uv.x, 0.01f + 0.02f * uv.y};
  for (Vec3f& p : hidden.positions) p = p + Vec3f(10, 0, 0);
  const Image image = test::alpha_image(64, test::opaque_inside(0.5, 0.5, 0.4, 0.4));
  const LeafSet leaves = leaves_of(masked(tree_of({card(2, 2), hidden}), image));
  EXPECT_EQ(leaves.sheets->sheets.size(), 1u);
  EXPECT_EQ(leaves.sheets->invisible, 1u);
  EXPECT_TRUE(std::ranges::any_of(leaves.warnings, [](const std::string& warning) {
    return warning.find("transparent") != std::string::npos;
  }));
}

TEST(LeafPoints, OfATextureThatHidesAllAreOfWholeTriangles) {
  const Image image = test::alpha_image(8, [](double, double) { return 0; });
  const LeafSet leaves = leaves_of(masked(tree_of({card(2, 3)}), image));
  EXPECT_NEAR(leaves.area, 6, 1e-9);
  EXPECT_FALSE(leaves.warnings.empty());
}

}  // namespace
}  // namespace leafhull
