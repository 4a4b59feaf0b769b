// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "surface/components.h"
#include "surface/metrics.h"
#include "surface/polygonise.h"
#include "surface/volume.h"
#include "unit/surface_test_fields.h"

namespace leafhull {
namespace {

constexpr Coord kLow{-16, -16, -16}, kHigh{16, 16, 16};

/// Directed edges, each counted: closed and consistently oriented means once each way.
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

double volume(const Polygons& polygons) {
  double sum = 0;
  for (const auto& [a, b, c] : triangulate(polygons)) {
    sum +=
        dot(Vec3d(polygons.points[a]), cross(Vec3d(polygons.points[b]), Vec3d(polygons.points[c])));
  }
  return sum / 6;
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
  // N = 2 at the origin, 0 around, T = 1: the octahedron of the crossings has half-axes of 1/2; a
  // dual vertex is the mean of the three crossings of its cell, at (1, 1, 1) / 6.
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
  // A box, its walls between samples.
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
  const openvdb::FloatTree& negated = field.negated().tree();
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

TEST(DensityGrid, IsOnTheGlobalLattice) {
  Field field({0.25, {320, -640, 32}}, 1.5);
  add_brick(field, [](Vec3d p) { return p == Vec3d(10, 3, 4) ? 7 : 0.5; }, {8, 0, 0});
  field.add_inside(std::vector<Block>{{{16, 0, 0}, 16}});
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
  // Inside for -4 <= x <= 4 on a 16^3 box of samples that is outside elsewhere.
  const auto slab = [](Vec3d p) {
    const bool in = std::fabs(p.x) <= 4 && std::fabs(p.y) <= 5 && std::fabs(p.z) <= 6;
    return in ? 2.0 : 0.0;
  };
  const Field field = field_of(slab, 1.0, kLow, kHigh);
  // Two leaf vertices in one cell, one at the middle of a cell on the surface (trilinear N = 1,
  // just on), one a little further out, one outside.
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
  std::vector<Block> inside;
  for (const Field::Brick* brick : dense.bricks()) {
    const Coord o{brick->origin().x(), brick->origin().y(), brick->origin().z()};
    const bool middle = std::abs(2 * o.x + 7) < 16 && std::abs(2 * o.y + 7) < 16 &&
                        std::abs(2 * o.z + 7) < 16;  // the eight bricks around the origin, inside
    if (middle) {
      inside.push_back({o, kBrickEdge});
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

Mesh tetrahedra(std::vector<float> sizes) {
  Mesh mesh;
  for (const float s : sizes) {
    const auto v = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3f p : {Vec3f{0, 0, 0}, Vec3f{s, 0, 0}, Vec3f{0, s, 0}, Vec3f{0, 0, s}}) {
      mesh.positions.push_back(p + Vec3f(100, 0, 0));
      mesh.normals.push_back({0, 0, s});
    }
    for (const auto& [a, b, c] :
         {std::array{0u, 2u, 1u}, {0u, 1u, 3u}, {0u, 3u, 2u}, {1u, 2u, 3u}}) {
      mesh.triangles.push_back({v + a, v + b, v + c});
    }
  }
  return mesh;
}

TEST(Components, SmallOnesAreDroppedByVolume) {
  // Volumes as 1 : 27 : 8.
  Mesh mesh = tetrahedra({1, 3, 2});
  const ComponentCount count = drop_small_components(mesh, 0.1);
  EXPECT_EQ(count.kept, 2u);
  EXPECT_EQ(count.dropped, 1u);
  ASSERT_EQ(mesh.positions.size(), 8u);
  EXPECT_EQ(mesh.normals[0], Vec3f(0, 0, 3));
  EXPECT_EQ(mesh.normals[4], Vec3f(0, 0, 2));
  EXPECT_TRUE(closed(mesh.triangles));
}

TEST(Components, AFractionOfZeroKeepsAll) {
  Mesh mesh = tetrahedra({1, 3, 2});
  EXPECT_EQ(drop_small_components(mesh, 0).kept, 3u);
  EXPECT_EQ(mesh.positions.size(), 12u);
}

}  // namespace
}  // namespace leafhull
