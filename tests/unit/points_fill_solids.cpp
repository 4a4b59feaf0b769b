// SPDX-License-Identifier: Apache-2.0
// Leaf points within closed crowns.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "leafhull/error.h"
#include "leaves/sheets.h"
#include "leaves_models.h"
#include "points/fill_solids.h"
#include "points/leaf_points.h"
#include "property/area_trees.h"
#include "unit/points_measures.h"

namespace leafhull {
namespace {

using test::area_of;
using test::layers_at;

using Triangles = std::vector<std::array<Vec3d, 3>>;

/// A solid whose leaf area is half its surface.
LeafSolid solid_of(Triangles triangles) {
  LeafSolid solid;
  double sixfold = 0;
  for (const auto& [a, b, c] : triangles) {
    solid.surface += length(cross(b - a, c - a)) / 2;
    sixfold += dot(a, cross(b, c));
  }
  solid.volume = std::abs(sixfold) / 6;
  solid.area = solid.surface / 2;
  solid.triangles = std::move(triangles);
  return solid;
}

Triangles triangles_of(const Primitive& p) {
  Triangles triangles;
  const auto at = [&](std::uint32_t v) { return Vec3d(p.positions[v]); };
  for (const auto& [a, b, c] : p.triangles) triangles.push_back({at(a), at(b), at(c)});
  return triangles;
}

/// A box of this edge around a centre.
Triangles box(Vec3d centre, Vec3d edge) {
  const Vec3d half[] = {{edge.x / 2, 0, 0}, {0, edge.y / 2, 0}, {0, 0, edge.z / 2}};
  Triangles triangles;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d n = half[axis], u = half[(axis + 1) % 3], v = half[(axis + 2) % 3];
    for (const double sign : {1.0, -1.0}) {
      const Vec3d at = centre + n * sign, w = v * sign;
      triangles.push_back({at - u - w, at + u - w, at + u + w});
      triangles.push_back({at - u - w, at + u + w, at - u + w});
    }
  }
  return triangles;
}
Triangles cube(double edge, Vec3d centre = {}) { return box(centre, {edge, edge, edge}); }

/// 80 faces in a ball of radius 2; none lies in a plane of the lattice.
Triangles ball() {
  Triangles triangles = triangles_of(test::closed_sphere().primitives[0]);
  for (auto& corners : triangles) {
    for (Vec3d& p : corners) {
      const double c = std::cos(0.7), s = std::sin(0.7);
      p = Vec3d(c * p.x - s * p.y + 0.0137, s * p.x + c * p.y, p.z + 0.0291);
    }
  }
  return triangles;
}

Vec3d centre_of(const std::vector<LeafPoint>& points) {
  Vec3d sum;
  for (const LeafPoint& point : points) sum = sum + point.position * point.area;
  return sum * (1 / area_of(points));
}

double volume_of_cell(double radius) { return std::pow(0.28 * radius, 3); }

TEST(IsFilled, WhatIsThickerThanHalfOfAKernel) {
  // A plate of volume V and surface S is 2 V / S thick; for a cube, that is a third of its edge.
  const LeafSolid solid = solid_of(cube(3));
  EXPECT_NEAR(solid.thickness(), 1, 1e-12);
  EXPECT_TRUE(is_filled(solid, 1.99));
  EXPECT_FALSE(is_filled(solid, 2.01));
  EXPECT_NEAR(solid_of(box({}, {100, 100, 1})).thickness(), 1, 0.03);
}

TEST(Fill, KeepsTheLeafArea) {
  for (const double radius : {0.2, 0.5, 1.3}) {
    for (const LeafSolid& solid :
         {solid_of(cube(3)), solid_of(ball()), solid_of(box({7, -3, 0.1}, {1, 5, 2.3}))}) {
      const std::vector<LeafPoint> points = fill(solid, radius);
      EXPECT_NEAR(area_of(points) / solid.area, 1, 1e-9);
      EXPECT_TRUE(std::ranges::all_of(points, [](const LeafPoint& p) { return p.area > 0; }));
    }
  }
}

TEST(Fill, MakesRoundPoints) {
  for (const LeafPoint& p : fill(solid_of(cube(2)), 0.5)) {
    EXPECT_GE(p.radius_minor, 0.5f);
    EXPECT_GE(p.radius_major, p.radius_minor);
    EXPECT_FLOAT_EQ(length(p.normal), 1);
    EXPECT_EQ(dot(p.normal, p.major), 0);
  }
}

TEST(Fill, IsInside) {
  for (const double radius : {0.2, 0.7}) {
    for (const LeafPoint& p : fill(solid_of(ball()), radius)) {
      EXPECT_LT(length(p.position - Vec3d(0.0137, 0, 0.0291)), 2);
    }
    for (const LeafPoint& p : fill(solid_of(cube(3, {10, 20, 30})), radius)) {
      const Vec3d d = p.position - Vec3d(10, 20, 30);
      EXPECT_LT(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}), 1.5);
    }
  }
}

TEST(Fill, LeavesAHollowEmpty) {
  Triangles shell = cube(6);
  const Triangles hollow = cube(3);
  shell.insert(shell.end(), hollow.begin(), hollow.end());
  LeafSolid solid = solid_of(shell);
  solid.volume = 6 * 6 * 6 - 3 * 3 * 3;
  const std::vector<LeafPoint> points = fill(solid, 0.5);
  EXPECT_NEAR(static_cast<double>(points.size()) * volume_of_cell(0.5) / solid.volume, 1, 0.35);
  // Cells at the hollow's walls may have their middle inside the hollow.
  for (const LeafPoint& p : points) {
    const auto [x, y, z] = p.position;
    EXPECT_GT(std::max({std::abs(x), std::abs(y), std::abs(z)}), 1.5 - 0.28 * 0.5);
  }
  EXPECT_LT(layers_at(points, {}, 0.5), 1e-12);
}

TEST(Fill, TakesTheCellsThatASolidMeets) {
  const std::vector<LeafPoint> points = fill(solid_of(cube(10)), 1);
  EXPECT_GE(points.size(), 35u * 35 * 35);
  EXPECT_LE(points.size(), 37u * 37 * 37);
  // A cube and a kernel of half the size give as many points.
  const std::vector<LeafPoint> half = fill(solid_of(cube(5)), 0.5);
  EXPECT_EQ(half.size(), points.size());
}

TEST(Fill, JoinsWhatLiesDeepInALargeOne) {
  const double cells = std::pow(20 / 0.28, 3);
  const LeafSolid solid = solid_of(cube(20));
  const std::vector<LeafPoint> points = fill(solid, 1);
  EXPECT_LT(static_cast<double>(points.size()), 0.75 * cells);
  EXPECT_GT(static_cast<double>(points.size()), 0.5 * cells);
  EXPECT_NEAR(area_of(points) / solid.area, 1, 1e-9);
  EXPECT_LT(length(centre_of(points)), 0.02);
  // Near the surface, out of reach of the joined points' kernels, each cell has its own point.
  const double cell = solid.area * volume_of_cell(1) / solid.volume;
  for (const LeafPoint& p : points) {
    const auto [x, y, z] = p.position;
    const double depth = 10 - std::max({std::abs(x), std::abs(y), std::abs(z)});
    EXPECT_LT(p.area, (depth < 2 ? 1.05 : 8.4) * cell);
  }
}

TEST(Fill, OfWholeCellsIsTheirMiddles) {
  // Lines of samples run along the faces' diagonals.
  const double radius = 4 / 0.28;
  const std::vector<LeafPoint> points = fill(solid_of(cube(8, {4, -4, 4})), radius);
  ASSERT_EQ(points.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(points[i].area, 6 * 64 / 2 / 8.0, 1e-9);
    EXPECT_NEAR(points[i].position.x, i & 4 ? 6 : 2, 1e-9);
    EXPECT_NEAR(points[i].position.y, i & 2 ? -2 : -6, 1e-9);
    EXPECT_NEAR(points[i].position.z, i & 1 ? 6 : 2, 1e-9);
  }
}

TEST(Fill, IsCompleteWhereLinesRunAlongFacesAndEdges) {
  // Samples lie at halves, so lines run in four of the faces.
  const double radius = 4 / 0.28;
  const LeafSolid solid = solid_of(cube(16, {0.5, 0.5, 0.5}));
  const std::vector<LeafPoint> points = fill(solid, radius);
  EXPECT_NEAR(area_of(points), solid.area, 1e-9 * solid.area);
  double most = 0;
  for (const LeafPoint& p : points) most = std::max(most, p.area);
  const auto whole =
      std::ranges::count_if(points, [&](const LeafPoint& p) { return p.area > most * 0.999; });
  EXPECT_GE(whole, 3 * 3 * 3);
  // No line is filled beyond the cube, which holds 16 or 17 samples along each axis.
  EXPECT_GE(solid.area / most * 64, std::pow(16, 3) - 1e-6);
  EXPECT_LE(solid.area / most * 64, std::pow(17, 3) + 1e-6);
  for (const LeafPoint& p : points) {
    const auto [x, y, z] = p.position - Vec3d(0.5, 0.5, 0.5);
    EXPECT_LE(std::max({std::abs(x), std::abs(y), std::abs(z)}), 8 + 1e-9);
  }
}

TEST(Fill, HasTheCentreOfTheVolume) {
  EXPECT_LT(length(centre_of(fill(solid_of(cube(3, {1.23, 4.56, -7.89})), 0.5)) -
                   Vec3d(1.23, 4.56, -7.89)),
            0.03);
  EXPECT_LT(length(centre_of(fill(solid_of(ball()), 0.5)) - Vec3d(0.0137, 0, 0.0291)), 0.02);
  const Vec3d a(0, 0, 0), b(4.1, 0.2, 0), c(0.3, 4, 0.1), d(0.2, 0.1, 4.3);
  const Triangles tetrahedron{{a, c, b}, {a, b, d}, {a, d, c}, {b, c, d}};
  EXPECT_LT(length(centre_of(fill(solid_of(tetrahedron), 0.4)) - (a + b + c + d) * 0.25), 0.03);
}

TEST(Fill, DoesNotCareForWinding) {
  const std::vector<LeafPoint> points = fill(solid_of(ball()), 0.5);
  Triangles turned = ball();
  for (std::size_t i = 0; i < turned.size(); i += 3) std::swap(turned[i][1], turned[i][2]);
  std::ranges::reverse(turned);
  LeafSolid solid = solid_of(ball());
  solid.triangles = turned;
  const std::vector<LeafPoint> same = fill(solid, 0.5);
  ASSERT_EQ(same.size(), points.size());
  for (std::size_t i = 0; i < same.size(); ++i) {
    EXPECT_LT(length(same[i].position - points[i].position), 1e-12);
    EXPECT_EQ(same[i].area, points[i].area);
  }
}

TEST(Fill, GoesWithTheLattice) {
  constexpr double kRadius = 0.5, kCell = 0.28 * kRadius;
  using Map = std::function<Vec3d(Vec3d)>;
  const std::pair<const char*, Map> maps[] = {
      {"moved", [](Vec3d p) { return p + Vec3d(3, -7, 11) * kCell; }},
      {"mirrored", [](Vec3d p) { return Vec3d(-p.x, p.y, p.z); }},
      {"mirrored in two", [](Vec3d p) { return Vec3d(p.x, -p.y, -p.z); }},
      {"turned", [](Vec3d p) { return Vec3d(-p.y, p.x, p.z); }},
      {"turned about a diagonal", [](Vec3d p) { return Vec3d(p.y, p.z, p.x); }},
  };
  const std::vector<LeafPoint> points = fill(solid_of(ball()), kRadius);
  for (const auto& [how, map] : maps) {
    SCOPED_TRACE(how);
    Triangles moved = ball();
    for (auto& corners : moved) {
      for (Vec3d& p : corners) p = map(p);
    }
    const std::vector<LeafPoint> there = fill(solid_of(moved), kRadius);
    ASSERT_EQ(there.size(), points.size());
    for (const LeafPoint& p : points) {
      const Vec3d at = map(p.position);
      const auto same = std::ranges::find_if(
          there, [&](const LeafPoint& q) { return length(q.position - at) < 1e-9; });
      ASSERT_NE(same, there.end());
      EXPECT_NEAR(same->area, p.area, 1e-9 * p.area);
    }
  }
}

TEST(Fill, IsEvenWithin) {
  // For k = 2, a leaf area of rho per volume adds up to N = 96/105 rho R.
  for (const double radius : {1.0, 0.73}) {
    const LeafSolid solid = solid_of(cube(8, {0.1, 0.2, 0.3}));
    const std::vector<LeafPoint> points = fill(solid, radius);
    const double expected = 96.0 / 105 * solid.area / solid.volume * radius;
    for (double x = -1.5; x <= 1.5; x += 0.37) {
      for (double y = -1.5; y <= 1.5; y += 0.37) {
        for (double z = -1.5; z <= 1.5; z += 0.37) {
          EXPECT_NEAR(layers_at(points, {x, y, z}, radius) / expected, 1, 0.03);
        }
      }
    }
    // On a face N is half of that.
    EXPECT_NEAR(layers_at(points, {4.1, 0.2, 0.3}, radius) / expected, 0.5, 0.05);
  }
}

TEST(Fill, RefusesTenMillionPoints) {
  EXPECT_NO_THROW(fill(solid_of(cube(5)), 0.5));
  try {
    fill(solid_of(cube(80)), 1);
    FAIL() << "went through";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(std::string(error.what()).find("ten million"), std::string::npos) << error.what();
    EXPECT_NE(error.remedy().find("--radius-max"), std::string::npos) << error.remedy();
  }
}

/// A closed box of 3 x 2 x 2, and a card of area 4 beside it.
LeafSet box_and_card() {
  TreeModel tree = test::closed_box();
  tree.instances.push_back({1, "node"});
  Primitive card = test::card(2, 2);
  for (Vec3f& p : card.positions) p = p + Vec3f(4, 0, 0);
  card.material = 0;
  tree.primitives.push_back(card);
  return find_leaves(tree, {});
}

TEST(AreaPoints, FillWhatIsThickAndKnowItsSamples) {
  const LeafSet leaves = box_and_card();
  const LeafPoints points = area_points(leaves, 0.2, 0.6);
  ASSERT_EQ(points.in_solid.size(), points.samples.size());
  double within = 0, area = 0;
  for (const LeafPoint& p : points.points) {
    area += p.area;
    const bool is_card = p.position.x > 2;
    if (is_card) continue;
    within += p.area;
    EXPECT_LT(std::abs(p.position.x), 1.5);
    EXPECT_LT(std::max(std::abs(p.position.y), std::abs(p.position.z)), 1);
  }
  EXPECT_NEAR(within, 32, 1e-6);
  const auto in_box =
      std::ranges::count_if(points.points, [](const LeafPoint& p) { return p.position.x < 2; });
  EXPECT_GE(static_cast<double>(in_box), 3 * 2 * 2 / volume_of_cell(0.6));
  EXPECT_NEAR(area, 36, 1e-6);
  EXPECT_NEAR(points.area, 36, 1e-6);
  std::size_t on_box = 0;
  for (std::size_t i = 0; i < points.samples.size(); ++i) {
    EXPECT_EQ(points.in_solid[i], points.samples[i].x < 2);
    on_box += points.in_solid[i];
  }
  EXPECT_NEAR(static_cast<double>(on_box) / static_cast<double>(points.samples.size()), 32.0 / 36,
              0.01);
}

TEST(AreaPoints, LeaveWhatIsThinASheet) {
  const LeafSet leaves = box_and_card();
  const LeafPoints points = area_points(leaves, 0.2, 10);
  EXPECT_NEAR(points.area, 36, 1e-6);
  EXPECT_TRUE(std::ranges::none_of(points.in_solid, [](bool in) { return in; }));
  for (const LeafPoint& p : points.points) {
    const bool on_face = std::abs(std::abs(p.position.x) - 1.5) < 0.2 ||
                         std::abs(std::abs(p.position.y) - 1) < 0.2 ||
                         std::abs(std::abs(p.position.z) - 1) < 0.2 || p.position.x > 2;
    EXPECT_TRUE(on_face);
  }
  EXPECT_TRUE(vertex_points(leaves).in_solid.empty());
}

}  // namespace
}  // namespace leafhull
