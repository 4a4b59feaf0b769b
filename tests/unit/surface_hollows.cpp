// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "density/field_grid.h"
#include "surface/brick_mesher.h"
#include "surface/density_grid.h"
#include "surface/hollows.h"
#include "surface/mesh_components.h"
#include "surface/metrics.h"
#include "surface/polygonise.h"
#include "unit/surface_test_fields.h"

namespace leafhull {
namespace {

/// A cube of samples above T = 1, except for those at `holes`.
Field cube_without(const std::set<Coord>& holes) {
  const auto density = [&](Vec3d p) {
    const bool in = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) <= 12;
    return in && !holes.count(cell_of(p)) ? 2.0 : 0.25;
  };
  return field_of(density, 1.0, kLow, kHigh);
}

void expect_filled(const std::set<Coord>& holes) {
  const Field field = cube_without(holes);
  const Field filled = fill_hollows(field);
  for (const Coord hole : holes) {
    EXPECT_FALSE(is_inside(field, hole));
    EXPECT_TRUE(is_inside(filled, hole));
  }
  const Metrics cube = measure(cube_without({}), {}), m = measure(filled, {});
  EXPECT_EQ(m.inside_voxels, cube.inside_voxels);
  EXPECT_EQ(m.on_voxels, cube.on_voxels);
}

/// Expects the very same grid: nothing was changed or copied.
void expect_as_it_was(const Field& field) {
  const Field filled = fill_hollows(field);
  EXPECT_EQ(&negated_grid(filled), &negated_grid(field));
  EXPECT_EQ(filled.inside().size(), field.inside().size());
}

void expect_same_values(const Field& a, const Field& b) {
  for (auto value = negated_grid(a).cbeginValueAll(); value; ++value) {
    EXPECT_EQ(negated_grid(b).tree().getValue(value.getCoord()), *value);
  }
  EXPECT_EQ(a.inside().size(), b.inside().size());
}

/// full_ball has radius 30; ball_shell is the same ball, hollow within radius 20.
double depth(Vec3d p) { return 30 - length(p); }
double full_ball(Vec3d p) { return 1 + std::min(depth(p), 5.0) / 4; }
double ball_shell(Vec3d p) { return 1 + std::min(depth(p), 10 - depth(p)) / 4; }

constexpr Coord kBallLow{-48, -48, -48}, kBallHigh{48, 48, 48};

void expect_same_surface(const Field& a, const Field& b) {
  const Polygons p = mesh_bricks(a), q = mesh_bricks(b);
  EXPECT_FALSE(p.points.empty());
  EXPECT_TRUE(p.points == q.points);
  EXPECT_TRUE(p.faces == q.faces);
  const std::vector<Vec3d> leaves{{0.5, 0.5, 0.5}, {10, 3, 2}, {25, 1, 1}, {29.9, 0.5, 0.5}};
  const Metrics m = measure(a, leaves), n = measure(b, leaves);
  EXPECT_EQ(m.inside_voxels, n.inside_voxels);
  EXPECT_EQ(m.on_voxels, n.on_voxels);
  EXPECT_EQ(m.dilated_voxels, n.dilated_voxels);
  EXPECT_EQ(m.off_site_sampled, n.off_site_sampled);
}

TEST(Hollows, AShellBecomesABall) {
  const Field hollow = band_of(ball_shell, {1.0}, kBallLow, kBallHigh);
  for (const Coord at : {Coord{0, 0, 0}, Coord{9, 3, 4}}) {  // in two blocks of the hollow
    ASSERT_FALSE(negated_grid(hollow).tree().probeConstLeaf(openvdb::Coord(at.x, at.y, at.z)));
    ASSERT_FALSE(is_inside(hollow, at));
  }
  const Field filled = fill_hollows(hollow);
  expect_same_surface(filled, band_of(full_ball, {1.0}, kBallLow, kBallHigh));
  for (const int x : {0, 19}) {  // in a block, and a sample of a brick
    EXPECT_EQ(negated_grid(filled).tree().getValue(openvdb::Coord(x, 0, 0)), -1) << x;
    EXPECT_FALSE(is_inside(hollow, {x, 0, 0})) << "what others hold has changed";
  }
  for (int x = 0; x < 29; ++x) {
    EXPECT_GE(density_grid(filled)->tree().getValue(openvdb::Coord(x, 0, 0)), 1) << "saved, " << x;
  }
}

TEST(Hollows, ADenseFieldIsFilledLikeTheBand) {
  const Field band = fill_hollows(band_of(ball_shell, {1.0}, kBallLow, kBallHigh));
  const Field dense = fill_hollows(field_of(ball_shell, 1.0, kBallLow, kBallHigh));
  EXPECT_GT(bricks_of(dense).size(), bricks_of(band).size());
  expect_same_surface(dense, band);
}

TEST(Hollows, BricksKeepTheirOrder) {
  const Field hollow = band_of(ball_shell, {1.0}, kBallLow, kBallHigh);
  const Field filled = fill_hollows(hollow);
  ASSERT_EQ(bricks_of(filled).size(), bricks_of(hollow).size());
  for (std::size_t b = 0; b < bricks_of(hollow).size(); ++b) {
    EXPECT_EQ(bricks_of(filled)[b]->origin(), bricks_of(hollow)[b]->origin());
    EXPECT_NE(bricks_of(filled)[b], bricks_of(hollow)[b]);
    EXPECT_TRUE(bricks_of(filled)[b]->isDense());
  }
}

TEST(Hollows, AFieldOfItsOwnIsNotCopied) {
  Field hollow = band_of(ball_shell, {1.0}, kBallLow, kBallHigh);
  const openvdb::FloatGrid* grid = &negated_grid(hollow);
  const Field filled = fill_hollows(std::move(hollow));
  EXPECT_EQ(&negated_grid(filled), grid);
  EXPECT_TRUE(is_inside(filled, {0, 0, 0}));
}

TEST(Hollows, ATunnelOneSampleWideLeadsOutside) {
  for (const int axis : {0, 1, 2}) {
    for (const double side : {-1.0, 1.0}) {
      const auto along = [&](Vec3d p) { return side * (axis == 0 ? p.x : axis == 1 ? p.y : p.z); };
      const auto tunnel = [&](Vec3d p) {
        const double across = std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z) - along(p);
        return along(p) > 0 && across == 0 ? 0.5 : ball_shell(p);
      };
      const Field open = band_of(tunnel, {1.0}, kBallLow, kBallHigh);
      expect_as_it_was(open);
      const auto plugged = [&](Vec3d p) { return along(p) == 24 ? ball_shell(p) : tunnel(p); };
      EXPECT_TRUE(is_inside(fill_hollows(band_of(plugged, {1.0}, kBallLow, kBallHigh)), {}));
    }
  }
}

TEST(Hollows, OneSampleWithinABrickAndAtItsCorners) {
  for (const Coord hole : {Coord{3, 4, 5}, Coord{0, 0, 0}, Coord{-1, 7, -8}}) expect_filled({hole});
}

TEST(Hollows, ALoneBrickIsOpenAtItsFaces) {
  for (const Coord hole : {Coord{0, 4, 4}, Coord{7, 4, 4}, Coord{4, 0, 4}, Coord{4, 7, 4},
                           Coord{4, 4, 0}, Coord{4, 4, 7}}) {
    Field field({}, 1.0);
    add_brick(field, [&](Vec3d p) { return cell_of(p) == hole ? 0.0 : 2.0; }, {0, 0, 0});
    expect_as_it_was(field);
  }
}

TEST(Hollows, AcrossTheCornerOfEightBricksAndAWholeBrick) {
  for (const auto& [low, high] : {std::pair<Coord, Coord>{{-2, -3, -1}, {2, 1, 3}},
                                  std::pair<Coord, Coord>{{0, -8, 0}, {8, 0, 8}}}) {
    std::set<Coord> holes;
    for_each_sample(low, high, [&](Coord at) { holes.insert(at); });
    expect_filled(holes);
  }
}

TEST(Hollows, ThatWindThroughBricks) {
  // Three arms, each through a face of its brick; the last reaches the outermost samples inside.
  std::set<Coord> holes;
  for (int i = -5; i <= 6; ++i) holes.insert({i, 2, 3});
  for (int i = -9; i <= 2; ++i) holes.insert({6, i, 3});
  for (int i = 3; i <= 11; ++i) holes.insert({6, -9, i});
  expect_filled(holes);
  holes.insert({6, -9, 12});  // the cube's own surface
  expect_as_it_was(cube_without(holes));
}

TEST(Hollows, ThoseThatAreOpenStayBesideThoseThatAreClosed) {
  // Both go through the same brick and nearly touch.
  std::set<Coord> open, closed;
  for (int z = 2; z <= 12; ++z) open.insert({2, 2, z});
  for (int z = 2; z <= 11; ++z) closed.insert({2, 4, z});
  std::set<Coord> both = open;
  both.insert(closed.begin(), closed.end());
  const Field filled = fill_hollows(cube_without(both));
  for (const Coord at : open) EXPECT_FALSE(is_inside(filled, at));
  for (const Coord at : closed) EXPECT_TRUE(is_inside(filled, at));
}

TEST(Hollows, DiagonalContactDoesNotConnect) {
  for (const Coord step : {Coord{0, 1, 1}, Coord{1, 0, 1}, Coord{1, 1, 0}, Coord{1, 1, 1}}) {
    // A tunnel from outside ends a diagonal step from the hollow, within a brick or between two.
    for (const int start : {3, 7}) {
      std::set<Coord> holes;
      const Coord end = Coord{start, start, start} + step;
      for (int x = end.x; x <= 12; ++x) holes.insert({x, end.y, end.z});
      expect_as_it_was(cube_without(holes));
      holes.insert({start, start, start});
      const Field filled = fill_hollows(cube_without(holes));
      EXPECT_TRUE(is_inside(filled, {start, start, start}));
      EXPECT_FALSE(is_inside(filled, end));
    }
  }
}

TEST(Hollows, IslandsWithinVanish) {
  const auto islands = [](Vec3d p) {
    const double nearer = std::min(length(p - Vec3d(5, 5, 5)), length(p + Vec3d(4, 0, 4)));
    return std::max(ball_shell(p), 1 + (3.3 - nearer) / 4);
  };
  const Field hollow = band_of(islands, {1.0}, kBallLow, kBallHigh);
  Polygons before = mesh_bricks(hollow);
  EXPECT_EQ(drop_small_components(before, 0).kept, 4u);
  const Field filled = fill_hollows(hollow);
  expect_same_surface(filled, band_of(full_ball, {1.0}, kBallLow, kBallHigh));
}

TEST(Hollows, AHollowWithinAnIslandWithinAHollow) {
  const auto onion = [](Vec3d p) { return 1.2 + std::sin(depth(p) * 2 * M_PI / 12); };
  const Field filled = fill_hollows(band_of(onion, {1.0}, kBallLow, kBallHigh));
  const auto far = [](Vec3d p) { return length(p) > 24 ? 1.2 + std::sin(depth(p) * M_PI / 6) : 2; };
  expect_same_surface(filled, fill_hollows(band_of(far, {1.0}, kBallLow, kBallHigh)));
}

TEST(Hollows, NothingChangesWhereThereIsNone) {
  expect_as_it_was(Field({}, 1.0));
  expect_as_it_was(band_of(full_ball, {1.0}, kBallLow, kBallHigh));
  expect_as_it_was(field_of(full_ball, 1.0, kBallLow, kBallHigh));
  const auto bowl = [](Vec3d p) { return p.z > 5 ? 0.0 : ball_shell(p); };
  expect_as_it_was(band_of(bowl, {1.0}, kBallLow, kBallHigh));
}

TEST(Hollows, BricksFarApartNeedNoRoomBetween) {
  Field field({}, 1.0);
  constexpr int kFar = 1 << 28;
  for (const Coord at : {Coord{-kFar, -kFar, -kFar}, Coord{kFar, 0, kFar - 8}}) {
    add_brick(
        field, [](Vec3d) { return 2.0; }, at);
  }
  expect_as_it_was(field);
  const auto hole = [](Vec3d p) { return cell_of(p) == Coord{3, 4, kFar - 100} ? 0.0 : 2.0; };
  add_brick(field, hole, {0, 0, block_origin({3, 4, kFar - 100}, kBrickEdge).z});
  EXPECT_TRUE(is_inside(fill_hollows(field), {3, 4, kFar - 100}));
}

TEST(Hollows, EachThresholdHasItsOwn) {
  // At 1 and 1.1 the hollow is closed; at 1.5 a tunnel opens it.
  const auto tunnelled = [](Vec3d p) {
    return p.x > 0 && p.y == 0 && p.z == 0 ? std::min(ball_shell(p), 1.2) : ball_shell(p);
  };
  const std::vector<double> thresholds{1.0, 1.1, 1.5};
  const Field shared = band_of(tunnelled, thresholds, kBallLow, kBallHigh);
  for (const double threshold : thresholds) {
    const Field field = shared.at(threshold);
    if (threshold > 1.2) {
      expect_as_it_was(field);
      continue;
    }
    const Field filled = fill_hollows(field);
    EXPECT_TRUE(is_inside(filled, {0, 0, 0}));
    expect_same_surface(filled, fill_hollows(band_of(tunnelled, {threshold}, kBallLow, kBallHigh)));
    EXPECT_FALSE(is_inside(shared.at(threshold), {0, 0, 0}));
  }
}

TEST(Hollows, WhatIsProvenForALowerThresholdIsOutsideAHigherOne) {
  // The core is proven inside at 1; at 2 it belongs to the hollow.
  const auto cored = [](Vec3d p) { return length(p) < 20 ? 1.5 : 2.0 * ball_shell(p); };
  const Field shared = band_of(cored, {1.0, 2.0}, kBallLow, kBallHigh);
  ASSERT_GT(shared.inside().size(), shared.at(2.0).inside().size());
  const Field filled = fill_hollows(shared.at(2.0));
  EXPECT_FALSE(is_inside(shared.at(2.0), {0, 0, 0}));
  EXPECT_TRUE(is_inside(filled, {0, 0, 0}));
  expect_same_surface(filled, fill_hollows(band_of(cored, {2.0}, kBallLow, kBallHigh)));
  expect_as_it_was(shared);
}

/// A random field with bricks of noise and with blocks proven inside and outside.
Field random_field(std::mt19937& random, double share_below, int coarseness) {
  std::map<Coord, double> values;
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto density = [&](Vec3d p) {
    const Coord at{static_cast<int>(std::floor(p.x / coarseness)),
                   static_cast<int>(std::floor(p.y / coarseness)),
                   static_cast<int>(std::floor(p.z / coarseness))};
    if (std::max({std::fabs(p.x + 0.5), std::fabs(p.y + 0.5), std::fabs(p.z + 0.5)}) > 15)
      return 0.0;
    const auto [found, is_new] = values.try_emplace(at, 0.0);
    if (is_new) found->second = uniform(random) < share_below ? 0.5 : 1.5;
    return found->second;
  };
  return band_of(density, {1.0}, {-24, -24, -24}, {24, 24, 24});
}

/// For each sample of [-24, 24)^3 below T, the number of its hollow; 0 for outside.
std::map<Coord, int> flooded(const Field& field, int& hollows) {
  std::map<Coord, int> of;
  const auto within = [](Coord c) {
    return std::min({c.x, c.y, c.z}) >= -24 && std::max({c.x, c.y, c.z}) < 24;
  };
  const auto flood = [&](Coord from, int number) {
    std::vector<Coord> todo{from};
    of[from] = number;
    while (!todo.empty()) {
      const Coord at = todo.back();
      todo.pop_back();
      for (const Coord step : {Coord{1, 0, 0}, Coord{-1, 0, 0}, Coord{0, 1, 0}, Coord{0, -1, 0},
                               Coord{0, 0, 1}, Coord{0, 0, -1}}) {
        const Coord next = at + step;
        if (!within(next) || is_inside(field, next) || of.count(next)) continue;
        of[next] = number;
        todo.push_back(next);
      }
    }
  };
  flood({-24, -24, -24}, 0);
  hollows = 0;
  for_each_sample({-24, -24, -24}, {24, 24, 24}, [&](Coord at) {
    if (!is_inside(field, at) && !of.count(at)) flood(at, ++hollows);
  });
  return of;
}

/// The number of pieces whose faces look inward: the walls of hollows.
int walls(const Polygons& polygons) {
  const std::vector<std::uint32_t> component = component_of_each(polygons);
  std::map<std::uint32_t, double> volume;
  for (const auto& t : triangulate(polygons)) {
    const auto corner = [&](int i) {
      return Vec3d(polygons.points[t[static_cast<std::size_t>(i)]]);
    };
    volume[component[t[0]]] += dot(corner(0), cross(corner(1), corner(2)));
  }
  return static_cast<int>(
      std::count_if(volume.begin(), volume.end(), [](const auto& v) { return v.second < 0; }));
}

TEST(Hollows, AreThoseOfAFloodOfAllSamples) {
  std::mt19937 random(11);
  int found = 0;
  for (const double share : {0.03, 0.2, 0.3, 0.4, 0.6}) {
    for (const int coarseness : {1, 3, 8, 9}) {
      SCOPED_TRACE(testing::Message() << share << ' ' << coarseness);
      const Field field = random_field(random, share, coarseness);
      int hollows = 0;
      const std::map<Coord, int> of = flooded(field, hollows);
      found += hollows;
      // The mesher sees the same hollows; each has one wall.
      EXPECT_EQ(walls(mesh_bricks(field)), hollows);
      EXPECT_EQ(walls(polygonise(field, 0)), hollows);
      const Field filled = fill_hollows(field);
      int wrong = 0;
      for_each_sample({-24, -24, -24}, {24, 24, 24}, [&](Coord at) {
        const auto below = of.find(at);
        wrong += is_inside(filled, at) != (below == of.end() || below->second > 0);
      });
      EXPECT_EQ(wrong, 0);
      EXPECT_EQ(walls(mesh_bricks(filled)), 0);
      EXPECT_EQ(walls(polygonise(filled, 0)), 0);
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(Hollows, ThreadsDoNotMatter) {
  std::mt19937 random(5);
  const Field field = random_field(random, 0.3, 1);
  const auto filled_by = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    return fill_hollows(field);
  };
  const Field one = filled_by(1), four = filled_by(4);
  ASSERT_NE(&negated_grid(one), &negated_grid(field));
  expect_same_values(one, four);
}

}  // namespace
}  // namespace leafhull
