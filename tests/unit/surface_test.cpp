// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "density/field_grid.h"
#include "surface/density_grid.h"
#include "surface/mesh_components.h"
#include "surface/metrics.h"
#include "surface/polygonise.h"
#include "unit/surface_test_fields.h"

namespace leafhull {
namespace {

/// Whether every edge occurs once each way, as in a closed, consistently oriented surface.
bool closed(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& [a, b, c] : triangles) {
    ++edges[{a, b}], ++edges[{b, c}], ++edges[{c, a}];
  }
  for (const auto& [edge, count] : edges) {
    const auto reverse = edges.find({edge.second, edge.first});
    if (count != 1 || reverse == edges.end() || reverse->second != 1) return false;
  }
  return !edges.empty();
}

Polygons surface_of(const Field& field, double adaptivity = 0) {
  return polygonise(field, adaptivity);
}

TEST(Polygonise, OneSampleInsideIsAClosedBoxAroundIt) {
  const auto peak = [](Vec3d p) { return p == Vec3d(1, 2, 3) ? 2.0 : 0.0; };
  const Polygons polygons = surface_of(field_of(peak, 1.0, kLow, kHigh));
  EXPECT_EQ(polygons.points.size(), 8u);
  EXPECT_EQ(polygons.faces.size(), 6u);
  EXPECT_TRUE(closed(triangulate(polygons)));
  EXPECT_GT(volume(polygons), 0) << "faces look inward";
}

TEST(Polygonise, TheSixEdgesOfOneSampleAreCutHalfway) {
  // N = 2 at the origin and 0 around it, T = 1: the crossings form an octahedron with half-axes of
  // 1/2. A dual vertex is the mean of the three crossings of its cell, at (1, 1, 1) / 6.
  const auto peak = [](Vec3d p) { return p == Vec3d(0, 0, 0) ? 2.0 : 0.0; };
  const Polygons polygons = surface_of(field_of(peak, 1.0, kLow, kHigh));
  for (const Vec3f p : polygons.points) {
    EXPECT_NEAR(std::fabs(p.x), 1 / 6.0, 1e-5);
    EXPECT_NEAR(std::fabs(p.y), 1 / 6.0, 1e-5);
    EXPECT_NEAR(std::fabs(p.z), 1 / 6.0, 1e-5);
  }
}

TEST(Polygonise, ASphereIsClosedOutwardAndRound) {
  const double radius = 10.3;
  const auto ball = [&](Vec3d p) { return 2 - dot(p, p) / (radius * radius); };
  const Polygons polygons = surface_of(field_of(ball, 1.0, kLow, kHigh));
  EXPECT_TRUE(closed(triangulate(polygons)));
  const double exact = 4.0 / 3 * M_PI * std::pow(radius, 3);
  EXPECT_NEAR(volume(polygons) / exact, 1, 0.02);
}

TEST(Polygonise, AdaptivityMergesFacesAndStaysClosed) {
  // A box whose walls lie between samples.
  const auto box = [](Vec3d p) {
    return 11.5 - std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  };
  const Field field = field_of(box, 1.0, kLow, kHigh);
  const Polygons regular = surface_of(field), adaptive = surface_of(field, 0.5);
  EXPECT_LT(adaptive.points.size(), regular.points.size() / 2);
  EXPECT_TRUE(closed(triangulate(adaptive)));
}

TEST(Polygonise, ASampleAtTheThresholdIsInside) {
  const auto step = [](Vec3d p) { return p.x <= 3 ? 1.0 : 0.0; };
  const Field field = field_of(step, 1.0, kLow, kHigh);
  const openvdb::FloatTree& negated = negated_grid(field).tree();
  EXPECT_LT(negated.getValue(openvdb::Coord(3, 0, 0)), field.iso_value());
  EXPECT_GT(negated.getValue(openvdb::Coord(4, 0, 0)), field.iso_value());
}

TEST(Triangulate, CutsAlongTheShorterDiagonal) {
  const Polygons kite{{{0, 0, 0}, {4, 1, 0}, {8, 0, 0}, {4, -1, 0}}, {{0, 1, 2, 3}, {0, 1, 2, 2}}};
  const auto triangles = triangulate(kite);
  ASSERT_EQ(triangles.size(), 3u);
  EXPECT_EQ(triangles[0], (std::array<std::uint32_t, 3>{0, 1, 3}));
  EXPECT_EQ(triangles[1], (std::array<std::uint32_t, 3>{1, 2, 3}));
  EXPECT_EQ(triangles[2], (std::array<std::uint32_t, 3>{0, 1, 2}));
}

TEST(Field, TheIsoValueTellsInsideExactly) {
  const float one = 1, below = std::nextafter(one, 0.0f), above = std::nextafter(one, 2.0f);
  for (const double threshold : {1.0, std::nextafter(1.0, 0.0), std::nextafter(1.0, 2.0)}) {
    const float iso = Field({}, threshold).iso_value();
    for (const float n : {0.0f, below, one, above}) {
      EXPECT_EQ(-n < iso, static_cast<double>(n) >= threshold) << n - 1 << ' ' << threshold - 1;
    }
  }
}

TEST(Field, KnowsItsHighestSample) {
  Field field({}, 1.0);
  EXPECT_EQ(field.highest(), 0);
  add_brick(field, [](Vec3d p) { return p.x + p.y / 10; }, {0, 0, 0});
  add_brick(field, [](Vec3d) { return 0.5; }, {8, 0, 0});
  EXPECT_EQ(field.highest(), 7.7f);
  EXPECT_EQ(field.sample_count(), 2u * kBrickSamples);
}

TEST(Field, ServesEveryThresholdThatItWasEvaluatedFor) {
  Field low({}, 1.0);
  add_brick(low, [](Vec3d) { return 2; }, {0, 0, 0});
  low.add_inside(std::vector<InsideBlock>{{{{8, 0, 0}, 8}, 1.0}, {{{16, 0, 0}, 16}, 2.5}});
  EXPECT_EQ(low.inside().size(), 2u);
  const Field high = low.at(2.5);
  ASSERT_EQ(high.inside().size(), 1u);
  EXPECT_EQ(high.inside()[0].origin, (Coord{16, 0, 0}));
  for (const Field& field : {low, high}) {
    const auto inside = [&](int x) {
      return negated_grid(field).tree().getValue(openvdb::Coord(x, 1, 1)) < field.iso_value();
    };
    EXPECT_TRUE(inside(17));
    EXPECT_EQ(inside(9), field.threshold() == 1.0);
    EXPECT_EQ(inside(1), field.threshold() == 1.0);
  }
}

TEST(DensityGrid, IsOnTheGlobalLattice) {
  Field field({0.25, {320, -640, 32}}, 1.5);
  add_brick(field, [](Vec3d p) { return p == Vec3d(10, 3, 4) ? 7 : 0.5; }, {8, 0, 0});
  field.add_inside(std::vector<InsideBlock>{{{{16, 0, 0}, 16}, 1.5}});
  const auto grid = density_grid(field);
  EXPECT_EQ(grid->getName(), "density");
  EXPECT_EQ(grid->metaValue<double>("threshold"), 1.5);
  const openvdb::Coord at(320 + 10, -640 + 3, 32 + 4);
  EXPECT_EQ(grid->tree().getValue(at), 7);
  EXPECT_TRUE(grid->tree().isValueOn(at));
  const openvdb::Vec3d world = grid->indexToWorld(at);
  EXPECT_DOUBLE_EQ(world.x(), 330 * 0.25);
  const openvdb::Coord inside(320 + 31, -640 + 15, 32 + 15);
  EXPECT_GE(grid->tree().getValue(inside), 1.5f);
  EXPECT_FALSE(grid->tree().isValueOn(inside));
  EXPECT_EQ(grid->tree().getValue(openvdb::Coord(0, 0, 0)), 0);
  EXPECT_EQ(grid->activeVoxelCount(), static_cast<openvdb::Index64>(kBrickSamples));
}

TEST(Metrics, OfASlabByHand) {
  // Samples are inside for |x| <= 4, |y| <= 5 and |z| <= 6.
  const auto slab = [](Vec3d p) {
    const bool in = std::fabs(p.x) <= 4 && std::fabs(p.y) <= 5 && std::fabs(p.z) <= 6;
    return in ? 2.0 : 0.0;
  };
  const Field field = field_of(slab, 1.0, kLow, kHigh);
  // Two leaf vertices are in one cell, one lies just on the surface in the middle of a cell
  // (trilinear N = 1), one a little further out, and one is outside.
  const std::vector<Vec3d> leaves{
      {0.2, 0.2, 0.2}, {0.7, 0.3, 0.1}, {4.49, 0.5, 0.5}, {4.51, 1.5, 0.5}, {9.5, 0.5, 0.5}};
  const Metrics m = measure(field, leaves);
  EXPECT_EQ(m.inside_voxels, 8u * 10 * 12);
  EXPECT_EQ(m.on_voxels, 10u * 12 * 14 - 8 * 10 * 12);
  EXPECT_EQ(m.dilated_voxels, m.inside_voxels + m.on_voxels - 3);
  EXPECT_EQ(m.off_site_sampled, 2u);
}

TEST(Metrics, ProvenBlocksCountLikeEvaluatedOnes) {
  const auto ball = [](Vec3d p) { return 2 - dot(p, p) / (14.2 * 14.2); };
  const Field dense = field_of(ball, 1.0, {-24, -24, -24}, {24, 24, 24});
  Field sparse({}, 1.0);
  std::vector<InsideBlock> inside;
  for (const Brick* brick : bricks_of(dense)) {
    const Coord o{brick->origin().x(), brick->origin().y(), brick->origin().z()};
    const bool middle = std::abs(2 * o.x + 7) < 16 && std::abs(2 * o.y + 7) < 16 &&
                        std::abs(2 * o.z + 7) < 16;  // the eight bricks around the origin
    if (middle) {
      inside.push_back({{o, kBrickEdge}, 1.0});
    } else {
      add_brick(sparse, ball, o);
    }
  }
  ASSERT_EQ(inside.size(), 8u);
  sparse.add_inside(inside);
  const std::vector<Vec3d> leaves{{1.5, 1.5, 1.5}, {13, 0.5, 0.5}};
  const Metrics a = measure(dense, leaves);
  const Metrics b = measure(sparse, leaves);
  EXPECT_EQ(a.inside_voxels, b.inside_voxels);
  EXPECT_EQ(a.on_voxels, b.on_voxels);
  EXPECT_EQ(a.dilated_voxels, b.dilated_voxels);
  EXPECT_EQ(a.off_site_sampled, b.off_site_sampled);
}

TEST(Metrics, CountTheCellsThatCornersTell) {
  // Bricks at random places with random samples on both sides.
  std::mt19937 random(7);
  std::uniform_int_distribution<int> five(0, 4);
  Field field({}, 1.0);
  for (int x = -16; x < 16; x += kBrickEdge) {
    for (int y = -16; y < 16; y += kBrickEdge) {
      for (int z = -16; z < 16; z += kBrickEdge) {
        if (five(random) == 0) continue;
        add_brick(field, [&](Vec3d) { return five(random) == 0 ? 0.5 : 1.5; }, {x, y, z});
      }
    }
  }
  std::uint64_t inside = 0, on = 0;
  for (const Brick* brick : bricks_of(field)) {
    for (openvdb::Index s = 0; s < kBrickSamples; ++s) {
      int corners = 0;
      for (int i = 0; i < 8; ++i) {
        const openvdb::Coord at =
            brick->offsetToGlobalCoord(s).offsetBy(i >> 2 & 1, i >> 1 & 1, i & 1);
        corners += negated_grid(field).tree().getValue(at) < -1;
      }
      inside += corners == 8;
      on += corners > 0 && corners < 8;
    }
  }
  ASSERT_GT(inside, 0u);
  const Metrics m = measure(field, {});
  EXPECT_EQ(m.inside_voxels, inside);
  EXPECT_EQ(m.on_voxels, on);
}

Polygons tetrahedra(std::vector<float> sizes) {
  Polygons polygons;
  for (const float s : sizes) {
    const auto v = static_cast<std::uint32_t>(polygons.points.size());
    for (const Vec3f p : {Vec3f{0, 0, 0}, Vec3f{s, 0, 0}, Vec3f{0, s, 0}, Vec3f{0, 0, s}}) {
      polygons.points.push_back(p + Vec3f(100, 0, 0));
    }
    for (const auto& [a, b, c] :
         {std::array{0u, 2u, 1u}, {0u, 1u, 3u}, {0u, 3u, 2u}, {1u, 2u, 3u}}) {
      polygons.faces.push_back({v + a, v + b, v + c, v + c});
    }
  }
  return polygons;
}

TEST(Components, SmallOnesAreDroppedByVolume) {
  // The volumes are as 1 : 27 : 8.
  Polygons polygons = tetrahedra({1, 3, 2});
  const ComponentCount count = drop_small_components(polygons, 0.1);
  EXPECT_EQ(count.kept, 2u);
  EXPECT_EQ(count.dropped, 1u);
  ASSERT_EQ(polygons.points.size(), 8u);
  EXPECT_EQ(polygons.points[1], Vec3f(103, 0, 0));
  EXPECT_EQ(polygons.points[5], Vec3f(102, 0, 0));
  EXPECT_TRUE(closed(triangulate(polygons)));
}

/// A tetrahedron of volume 4/3 and a cube of volume 8 whose last corner is moved to `corner`.
Polygons tetrahedron_and_cube(Vec3f corner) {
  Polygons polygons = tetrahedra({2});
  for (int i = 0; i < 8; ++i) {
    polygons.points.push_back({i & 4 ? 2.0f : 0, i & 2 ? 2.0f : 0, i & 1 ? 2.0f : 0});
  }
  polygons.points.back() = corner;
  for (const auto& [a, b, c, d] : {std::array{0u, 1u, 3u, 2u},
                                   {4u, 6u, 7u, 5u},
                                   {0u, 4u, 5u, 1u},
                                   {2u, 3u, 7u, 6u},
                                   {0u, 2u, 6u, 4u},
                                   {1u, 5u, 7u, 3u}}) {
    polygons.faces.push_back({4 + a, 4 + b, 4 + c, 4 + d});
  }
  return polygons;
}

TEST(Components, AQuadCountsWhole) {
  // The tetrahedron is 0.167 of the cube; if quads counted half, it would be 0.33.
  Polygons polygons = tetrahedron_and_cube({2, 2, 2});
  Polygons same = polygons;
  EXPECT_EQ(drop_small_components(same, 0.16).kept, 2u);
  EXPECT_EQ(drop_small_components(polygons, 0.17).kept, 1u);
  EXPECT_EQ(polygons.points.size(), 8u);
}

TEST(Components, WhereAQuadBeginsDoesNotMatter) {
  // With one corner moved out, three of the cube's quads are not flat.
  Polygons polygons = tetrahedron_and_cube({3, 3, 3});
  // Folded one way or the other, the cube's volume is 10 or 12; 4/3 is 0.1212 of their mean.
  for (int turn = 0; turn < 4; ++turn) {
    Polygons below = polygons, above = polygons;
    EXPECT_EQ(drop_small_components(below, 0.1205).kept, 2u) << turn;
    EXPECT_EQ(drop_small_components(above, 0.1220).kept, 1u) << turn;
    for (std::size_t f = 4; f < polygons.faces.size(); ++f) {
      auto& face = polygons.faces[f];
      std::rotate(face.begin(), face.begin() + 1, face.end());
    }
  }
}

TEST(Components, AreFoundAcrossManyTriangles) {
  // A strip whose triangles come in random order, and a thousand small pieces beside it.
  constexpr std::uint32_t kLength = 50'000;
  Polygons polygons = tetrahedra(std::vector<float>(1000, 0.01f));
  for (std::uint32_t i = 0; i < kLength; ++i) {
    polygons.points.push_back({static_cast<float>(i), i % 2 ? 1.0f : 0.0f, i % 3 ? 1.0f : 0.0f});
  }
  for (std::uint32_t i = 4000; i + 2 < 4000 + kLength; ++i) {
    polygons.faces.push_back({i, i + 1, i + 2, i + 2});
  }
  std::shuffle(polygons.faces.begin(), polygons.faces.end(), std::mt19937(3));
  const ComponentCount count = drop_small_components(polygons, 0.001);
  EXPECT_EQ(count.kept, 1u);
  EXPECT_EQ(count.dropped, 1000u);
  EXPECT_EQ(polygons.points.size(), kLength);
  EXPECT_EQ(polygons.faces.size(), kLength - 2);
}

TEST(Components, AFractionOfZeroKeepsAll) {
  Polygons polygons = tetrahedra({1, 3, 2});
  EXPECT_EQ(drop_small_components(polygons, 0).kept, 3u);
  EXPECT_EQ(polygons.points.size(), 12u);
}

}  // namespace
}  // namespace leafhull
