// SPDX-License-Identifier: Apache-2.0
// A forest's surface does not depend on how it is cut into tiles.
#include "leafhull/forest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include "property/canopies.h"
#include "property/extractions.h"
#include "tiles/compute_tile.h"
#include "tiles/tile_plan.h"

namespace leafhull {
namespace {

using test::device;
using test::placed;

using Point = std::array<double, 6>;  // position and normal
using FacePoints = std::array<Point, 3>;

/// A crown of quads on a sphere shell, thick enough to be a surface.
LeafSet crown(unsigned seed, int leaves, double radius) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0 * 2 - 1; };
  LeafSet set;
  while (static_cast<int>(set.leaf_count) < leaves) {
    const Vec3d p(uniform(), uniform(), uniform());
    const double l = length(p);
    if (l > 1 || l < 0.3) continue;
    const Vec3d n = normalized(Vec3d(uniform(), uniform(), uniform()));
    const Vec3d u = normalized(cross(n, Vec3d(0.3, 0.5, 0.8)));
    const Vec3d v = cross(n, u);
    for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      const Vec3d c = p * radius + u * (0.12 * a) + v * (0.06 * b) + Vec3d(0, 2 * radius, 0);
      set.vertices.push_back(
          {c, Vec3f(n), Vec3f(u), 0.12f, 0.06f, static_cast<std::uint32_t>(set.leaf_count)});
      set.bounds.include(c);
    }
    ++set.leaf_count;
  }
  set.crown = set.bounds;
  set.mean_radius_major = 0.12;
  return set;
}

Scene grove(Vec3d origin) {
  Scene scene;
  scene.models.resize(2);
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int i = 0; i < 24; ++i) {
    scene.trees.push_back(placed(i % 2 == 0 ? 0 : 1,
                                 origin + Vec3d(30 * uniform(), uniform(), 30 * uniform()),
                                 6 * uniform(), 0.7 + 0.6 * uniform()));
  }
  scene.trees.push_back(scene.trees.front());  // two trees in one place,
  scene.trees.back().linear[1] = 0.4f;         // one of them sheared
  return scene;
}

Options options(std::optional<double> radius_max = {}) {
  Options o;
  o.points = PointSource::vertices;  // the crowns below only have vertices
  o.voxel_size = 0.2;
  o.radius_max = radius_max;
  return resolve(o);
}

struct Surface {
  std::set<Point> points;
  std::multiset<FacePoints> triangles;
  std::uint64_t own = 0;
};

Point point(const Mesh& mesh, std::uint32_t v) {
  const Vec3d p = mesh.origin + Vec3d(mesh.positions[v]), n(mesh.normals[v]);
  return {p.x, p.y, p.z, n.x, n.y, n.z};
}

/// The surface of all tiles; the corners of a triangle begin with the least.
Surface surface_of(const ForestLevel& level, int edge) {
  Surface all;
  const TilePlan plan(level, edge);
  std::map<std::pair<Coord, std::uint32_t>, Point> shared;
  for (std::size_t t = 0; t < plan.size(); ++t) {
    const TileSurface tile = compute_tile(level, {plan.tiles()[t], edge, plan.trees(t)}, device());
    all.own += tile.own_vertices;
    for (std::uint32_t v = 0; v < tile.mesh.positions.size(); ++v)
      all.points.insert(point(tile.mesh, v));
    for (const auto* list : {&tile.borrowed, &tile.lent}) {
      for (const SeamVertex& s : *list) {
        const auto [at, added] = shared.try_emplace({s.cell, s.patch}, point(tile.mesh, s.vertex));
        EXPECT_EQ(at->second, point(tile.mesh, s.vertex))
            << "a seam vertex is the same bits on both sides";
      }
    }
    for (const auto& t3 : tile.mesh.triangles) {
      FacePoints corners{point(tile.mesh, t3[0]), point(tile.mesh, t3[1]), point(tile.mesh, t3[2])};
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      all.triangles.insert(corners);
    }
  }
  return all;
}

/// The number of edges that do not occur once in each direction.
std::size_t open_edges(const Surface& surface) {
  std::map<std::pair<Point, Point>, int> edges;
  for (const FacePoints& t : surface.triangles) {
    for (int i = 0; i < 3; ++i) {
      ++edges[{t[i], t[(i + 1) % 3]}];
      --edges[{t[(i + 1) % 3], t[i]}];
    }
  }
  return static_cast<std::size_t>(
      std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.second != 0; }));
}

ForestLevel level_of(const Scene& scene, int number = 0, const Options& resolved = options()) {
  const std::vector<LeafSet> models{crown(1, 900, 3), crown(2, 500, 2)};
  const std::vector<Options> shapes(models.size(), resolved);
  const ForestLevel finest = prepare_level(0, scene, models, shapes, 0.2, nullptr, device());
  // `least` stays 0, because tiles alone do not show how large a piece over seams is.
  return number == 0 ? finest
                     : prepare_level(number, scene, models, shapes, 0.2, &finest, device());
}

void expect_same_surface(const Surface& a, const Surface& b) {
  EXPECT_EQ(a.own, b.own);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(Forest, TilesMeetWithoutCracksAndDoNotDependOnTheCut) {
  const Scene scene = grove({-15, 0, -15});
  const ForestLevel level = level_of(scene);
  const Surface whole = surface_of(level, 512);
  EXPECT_GT(whole.triangles.size(), 50000u);
  EXPECT_EQ(open_edges(whole), 0u);
  for (const int edge : {32, 64, 96}) {
    SCOPED_TRACE(edge);
    expect_same_surface(surface_of(level, edge), whole);
  }
}

TEST(Forest, FarFromTheOriginToo) {
  const Scene scene = grove({300000, 0, -200000});
  const ForestLevel level = level_of(scene);
  const Surface whole = surface_of(level, 512);
  EXPECT_EQ(open_edges(whole), 0u);
  expect_same_surface(surface_of(level, 64), whole);
}

TEST(Forest, WithControlOverTheScene) {
  const Scene scene = grove({-15, 0, -15});
  ForestLevel level = level_of(scene);
  level.scope = ControlScope::scene;
  level.scene_statistics = DensityStatistics{.mean = 8, .variance = 9, .p1 = 8, .p2 = 14};
  expect_same_surface(surface_of(level, 64), surface_of(level, 512));
}

/// The radii of kernels around a tile depend on trees whose own kernels do not reach the tile.
TEST(Forest, WithControlByTreesThatReachOnlyItsNeighbours) {
  Scene scene;
  scene.models.resize(2);
  scene.trees = {placed(0, {9, 0, 6}, 0, 1), placed(0, {15, 0, 6}, 1, 1)};
  ForestLevel level = level_of(scene, 0, options(53));
  EXPECT_GT(level.reach, 12 * level.voxel_size);
  level.scope = ControlScope::scene;
  level.threshold = 20;
  level.scene_statistics = DensityStatistics{.mean = 8, .variance = 9, .p1 = 300, .p2 = 2000};
  const Surface whole = surface_of(level, 512);
  EXPECT_GT(whole.triangles.size(), 1000u);
  expect_same_surface(surface_of(level, 32), whole);
}

TEST(Forest, OnALevelOfAbstraction) {
  const Scene scene = grove({-15, 0, -15});
  const ForestLevel level = level_of(scene, 2);
  const Surface whole = surface_of(level, 512);
  EXPECT_GT(whole.triangles.size(), 500u);
  EXPECT_EQ(open_edges(whole), 0u);
  expect_same_surface(surface_of(level, 32), whole);
}

}  // namespace
}  // namespace leafhull
