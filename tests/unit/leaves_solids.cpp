// SPDX-License-Identifier: Apache-2.0
// Which components enclose a volume.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "leaves/leaf_components.h"
#include "leaves/sheets.h"
#include "leaves/solids.h"
#include "leaves_models.h"

namespace leafhull {
namespace {

using test::add_back_faces;
using test::add_quad;
using test::card;
using test::tree_of;

/// The closed surface of a primitive that has one component.
std::vector<EigenTriangle> closed(const Primitive& primitive) {
  const WeldedMesh mesh = weld(primitive, weld_positions(primitive));
  const FaceGroups components = connected_components(mesh);
  EXPECT_EQ(components.size(), 1u);
  LeafMesh component;
  component.assign(mesh, components[0], Eigen::Matrix3d::Identity());
  return closed_surface(component);
}

/// The volume; it is positive if the triangles face outward.
double volume(const std::vector<EigenTriangle>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += a.dot(b.cross(c));
  return sum / 6;
}

double area(const std::vector<EigenTriangle>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles) sum += (b - a).cross(c - a).norm() / 2;
  return sum;
}

/// A box whose faces look outward.
Primitive box(Vec3f low, Vec3f high) {
  Primitive p;
  const auto at = [&](int i) {
    return Vec3f(i & 4 ? high.x : low.x, i & 2 ? high.y : low.y, i & 1 ? high.z : low.z);
  };
  for (const auto& [a, b, c, d] : {std::array{0, 1, 3, 2},
                                   {4, 6, 7, 5},
                                   {0, 4, 5, 1},
                                   {2, 3, 7, 6},
                                   {0, 2, 6, 4},
                                   {1, 5, 7, 3}}) {
    add_quad(p, {at(a), at(b), at(c), at(d)});
  }
  return p;
}

void append(Primitive& to, const Primitive& more) {
  const auto first = static_cast<std::uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), more.positions.begin(), more.positions.end());
  for (const auto& [a, b, c] : more.triangles) {
    to.triangles.push_back({first + a, first + b, first + c});
  }
}

/// The part of a sphere of radius 2 from its top down to the height `foot`, where it is open.
Primitive dome(double foot) {
  constexpr int kAround = 24, kDown = 12;
  Primitive p;
  const auto at = [&](int i, int j) {
    const double down = std::acos(foot / 2) * j / kDown;
    const double turn = 2 * std::numbers::pi * (i % kAround) / kAround;
    return Vec3f(
        Vec3d(std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn), std::cos(down)) *
        2.0);
  };
  for (int i = 0; i < kAround; ++i) {
    for (int j = 0; j < kDown; ++j) {
      if (j == 0) {
        const auto first = static_cast<std::uint32_t>(p.positions.size());
        p.positions.insert(p.positions.end(), {Vec3f(0, 0, 2), at(i, 1), at(i + 1, 1)});
        p.triangles.push_back({first, first + 1, first + 2});
      } else {
        add_quad(p, {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
      }
    }
  }
  return p;
}

/// The volume of such a sphere from its top down to the height `foot`.
double cap_volume(double foot) {
  const double height = 2 - foot;
  return std::numbers::pi * height * height * (6 - height) / 3;
}

TEST(ClosedSurface, OfACubeIsTheCube) {
  const auto cube = closed(box({-1, -1, -1}, {1, 1, 1}));
  EXPECT_EQ(cube.size(), 12u);
  EXPECT_DOUBLE_EQ(volume(cube), 8);
  EXPECT_DOUBLE_EQ(area(cube), 24);
}

TEST(ClosedSurface, OfACubeTurnedInsideOutEnclosesAsMuch) {
  Primitive cube = box({0, 0, 0}, {1, 2, 3});
  for (auto& [a, b, c] : cube.triangles) std::swap(b, c);
  EXPECT_DOUBLE_EQ(volume(closed(cube)), -6);
}

TEST(ClosedSurface, CountsFrontAndBackOnce) {
  Primitive cube = box({-1, -1, -1}, {1, 1, 1});
  add_back_faces(cube);
  const auto once = closed(cube);
  EXPECT_EQ(once.size(), 12u);
  EXPECT_DOUBLE_EQ(area(once), 24);
  EXPECT_DOUBLE_EQ(std::abs(volume(once)), 8);
  // Exporters may write separate vertices for the back faces.
  Primitive stored = box({-1, -1, -1}, {1, 1, 1});
  Primitive back = stored;
  for (auto& [a, b, c] : back.triangles) std::swap(b, c);
  append(stored, back);
  EXPECT_EQ(closed(stored).size(), 12u);
}

TEST(ClosedSurface, FacesBetweenTwoCubesCancel) {
  Primitive cubes = box({0, 0, 0}, {1, 1, 1});
  append(cubes, box({1, 0, 0}, {2, 1, 1}));
  EXPECT_EQ(closed(cubes).size(), 20u);
  EXPECT_DOUBLE_EQ(volume(closed(cubes)), 2);
  EXPECT_DOUBLE_EQ(area(closed(cubes)), 10);
}

TEST(ClosedSurface, FacesBetweenTwoCubesMayBeCutUnalike) {
  Primitive cubes = box({0, 0, 0}, {1, 1, 1}), next = box({1, 0, 0}, {2, 1, 1});
  next.triangles[0] = {1, 2, 3};
  next.triangles[1] = {1, 3, 0};
  append(cubes, next);
  EXPECT_DOUBLE_EQ(volume(closed(cubes)), 2);
}

TEST(ClosedSurface, OfADomeHasAConeAtItsFoot) {
  for (const double foot : {-1.0, 0.0, 0.1}) {
    SCOPED_TRACE(foot);
    const Primitive open = dome(foot);
    const auto surface = closed(open);
    EXPECT_EQ(surface.size(), open.triangles.size() + 24);
    EXPECT_NEAR(volume(surface) / cap_volume(foot), 1, 0.03) << "24 corners around it";
  }
}

TEST(ClosedSurface, OfAShallowBowlIsNone) { EXPECT_TRUE(closed(dome(1)).empty()); }

TEST(ClosedSurface, OfABoxWithoutALidIsTheBox) {
  Primitive open = box({-1, -1, -1}, {1, 1, 1});
  open.triangles.resize(10);
  const auto surface = closed(open);
  EXPECT_NEAR(volume(surface), 8, 1e-12);
  EXPECT_NEAR(area(surface), 24, 1e-12);
}

TEST(ClosedSurface, OfATubeHasTwoCones) {
  Primitive tube = box({-1, -1, -2}, {1, 1, 2});
  // Removes the faces at both ends.
  std::erase_if(tube.triangles, [&](const auto& t) {
    const float z = tube.positions[t[0]].z;
    return tube.positions[t[1]].z == z && tube.positions[t[2]].z == z;
  });
  EXPECT_EQ(tube.triangles.size(), 8u);
  EXPECT_NEAR(volume(closed(tube)), 16, 1e-12);
}

TEST(ClosedSurface, OfACardIsNone) {
  EXPECT_TRUE(closed(card(2, 3)).empty());
  Primitive both = card(2, 3);
  add_back_faces(both);
  EXPECT_TRUE(closed(both).empty());
  Primitive bent = card(2, 3);
  bent.positions[2].z = bent.positions[3].z = 1;
  EXPECT_TRUE(closed(bent).empty());
  Primitive folded;
  add_quad(folded, {Vec3f{-1, 0, 0}, {0, 0, 0}, {0, 2, 0}, {-1, 2, 0}});
  add_quad(folded, {Vec3f{0, 0, 0}, {0.5f, 0, 1}, {0.5f, 2, 1}, {0, 2, 0}});
  EXPECT_TRUE(closed(folded).empty());
  add_back_faces(folded);
  EXPECT_TRUE(closed(folded).empty());
}

TEST(ClosedSurface, OfCrossedCardsIsNone) {
  Primitive crossed;
  const Vec3f low(0, -1, 0), high(0, 1, 0);
  for (const Vec3f out : {Vec3f(1, 0, 0), {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}}) {
    add_quad(crossed, {low, low + out, high + out, high});
  }
  EXPECT_TRUE(closed(crossed).empty());
  add_back_faces(crossed);
  EXPECT_TRUE(closed(crossed).empty());
}

TEST(ClosedSurface, PassesOverFacesThatAreLines) {
  Primitive cube = box({-1, -1, -1}, {1, 1, 1});
  cube.triangles.push_back({0, 0, 1});
  cube.triangles.push_back({2, 3, 2});
  EXPECT_DOUBLE_EQ(volume(closed(cube)), 8);
}

TEST(LeafSolids, OfATreeHaveTheirVolumeAndArea) {
  Primitive two = box({0, 0, 0}, {2, 2, 3});
  append(two, box({10, 0, 0}, {14, 4, 4}));
  TreeModel tree = tree_of({two, card(2, 2)});
  tree.instances.push_back({0, "node", {{{2, 0, 0, 5}, {0, 2, 0, 50}, {0, 0, 2, 0}}}});
  const LeafSet leaves = find_leaves(tree, {});
  const std::vector<LeafSolid>& solids = leaves.sheets->solids;
  ASSERT_EQ(solids.size(), 4u);
  std::multiset<double> volumes;
  double areas = 4;
  for (const LeafSolid& solid : solids) {
    volumes.insert(std::round(solid.volume * 1e6) / 1e6);
    EXPECT_NEAR(solid.area, solid.surface, 1e-6 * solid.surface);
    EXPECT_NEAR(solid.thickness(), 2 * solid.volume / solid.surface, 1e-12);
    areas += solid.area;
  }
  EXPECT_EQ(volumes, (std::multiset<double>{12, 64, 96, 512}));
  EXPECT_NEAR(leaves.area, areas, 1e-6 * areas);
  std::size_t of_none = 0;
  std::vector<double> area(solids.size());
  for (const LeafSheet& sheet : leaves.sheets->sheets) {
    if (sheet.solid < 0) {
      ++of_none;
    } else {
      area.at(static_cast<std::size_t>(sheet.solid)) += sheet.area;
    }
  }
  EXPECT_EQ(of_none, 1u) << "the card";
  for (std::size_t i = 0; i < solids.size(); ++i) EXPECT_NEAR(area[i], solids[i].area, 1e-9);
}

TEST(LeafSolids, OfAMaskHaveItsVisibleArea) {
  Primitive cube = box({-1, -1, -1}, {1, 1, 1});
  for (int i = 0; i < 6; ++i) {
    cube.uvs.insert(cube.uvs.end(), {Vec2f{0, 1}, {1, 1}, {1, 0}, {0, 0}});
  }
  const Image left = test::alpha_image(16, [](double u, double) { return u < 0.5 ? 255 : 0; });
  const LeafSet leaves = find_leaves(test::masked(tree_of({cube}), left), {});
  ASSERT_EQ(leaves.sheets->solids.size(), 1u);
  EXPECT_NEAR(leaves.sheets->solids[0].area, 12, 1e-6);
  EXPECT_NEAR(leaves.sheets->solids[0].surface, 24, 1e-6);
  EXPECT_NEAR(leaves.sheets->solids[0].volume, 8, 1e-6);
}

TEST(LeafSolids, StandInAnOrderOfTheirOwn) {
  std::vector<Primitive> boxes;
  for (int i = 0; i < 5; ++i) {
    const auto x = static_cast<float>(3 * (i * 2 % 5));
    boxes.push_back(box({x, 0, 0}, {x + 1, 1 + 0.1f * x, 1}));
  }
  const LeafSet a = find_leaves(tree_of(boxes), {});
  std::ranges::reverse(boxes);
  for (Primitive& p : boxes) std::ranges::reverse(p.triangles);
  const LeafSet b = find_leaves(tree_of(boxes), {});
  ASSERT_EQ(a.sheets->solids.size(), 5u);
  ASSERT_EQ(b.sheets->solids.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(a.sheets->solids[i].triangles, b.sheets->solids[i].triangles);
    EXPECT_EQ(a.sheets->solids[i].volume, b.sheets->solids[i].volume);
    EXPECT_EQ(a.sheets->solids[i].area, b.sheets->solids[i].area);
  }
}

}  // namespace
}  // namespace leafhull
