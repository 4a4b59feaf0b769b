// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "leafhull/error.h"
#include "leaves_models.h"

namespace leafhull {
namespace {

using test::add_back_faces;
using test::add_quad;
using test::card;
using test::tree_of;

struct Expected {
  std::size_t leaves, vertices, split;
};

void expect_counts(const LeafSet& set, const Expected& expected) {
  EXPECT_EQ(set.leaf_count, expected.leaves);
  EXPECT_EQ(set.vertices.size(), expected.vertices);
  EXPECT_EQ(set.split_components, expected.split);
  EXPECT_EQ(set.dropped_leaves, 0u);
}

/// Two unit squares that cross in the z axis, each in two halves that share the axis' two vertices.
Primitive crossed_cards() {
  Primitive primitive;
  primitive.positions = {{0, 0, -0.5f},     {0, 0, 0.5f},     {0.5f, 0, -0.5f}, {0.5f, 0, 0.5f},
                         {-0.5f, 0, -0.5f}, {-0.5f, 0, 0.5f}, {0, 0.5f, -0.5f}, {0, 0.5f, 0.5f},
                         {0, -0.5f, -0.5f}, {0, -0.5f, 0.5f}};
  for (std::uint32_t outer = 2; outer < 10; outer += 2) {
    primitive.triangles.push_back({0, outer, outer + 1});
    primitive.triangles.push_back({0, outer + 1, 1});
  }
  return primitive;
}

/// A strip of unit length in z whose cross-section is the given points of the x, y plane.
Primitive strip(const std::vector<Vec2f>& section) {
  Primitive primitive;
  for (std::uint32_t i = 0; i < section.size(); ++i) {
    primitive.positions.push_back({section[i].x, section[i].y, 0});
    primitive.positions.push_back({section[i].x, section[i].y, 1});
    if (i == 0) continue;
    primitive.triangles.push_back({2 * i - 2, 2 * i, 2 * i + 1});
    primitive.triangles.push_back({2 * i - 2, 2 * i + 1, 2 * i - 1});
  }
  return primitive;
}

/// The unit sphere as an octahedron whose faces are cut into n * n triangles.
Primitive sphere(int n) {
  Primitive primitive;
  const auto corner = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c, int i, int j) {
    // Rounding to multiples keeps corners that two faces share equal to the bit.
    const Vec3d p = normalized(a * double(n - i - j) + b * double(i) + c * double(j));
    const auto round = [](double x) { return static_cast<float>(std::round(x * 4096) / 4096); };
    primitive.positions.push_back({round(p.x), round(p.y), round(p.z)});
    return static_cast<std::uint32_t>(primitive.positions.size() - 1);
  };
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3d a{octant & 1 ? 1. : -1., 0, 0};
    const Vec3d b{0, octant & 2 ? 1. : -1., 0};
    const Vec3d c{0, 0, octant & 4 ? 1. : -1.};
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        primitive.triangles.push_back(
            {corner(a, b, c, i, j), corner(a, b, c, i + 1, j), corner(a, b, c, i, j + 1)});
        if (i + j + 1 == n) continue;
        primitive.triangles.push_back(
            {corner(a, b, c, i + 1, j), corner(a, b, c, i + 1, j + 1), corner(a, b, c, i, j + 1)});
      }
    }
  }
  return primitive;
}

TEST(LeafComponents, SeparateQuadsAreSeparateLeaves) {
  Primitive cards = card(1, 1);
  add_quad(cards, {Vec3f{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}});
  cards.uvs.clear();
  expect_counts(find_leaves(tree_of({cards}), {}), {2, 8, 0});
}

TEST(LeafComponents, BitEqualPositionsAreOneVertex) {
  Primitive split = card(1, 1);
  split.positions = {split.positions[0], split.positions[1], split.positions[2],
                     split.positions[0], split.positions[2], split.positions[3]};
  split.triangles = {{0, 1, 2}, {3, 4, 5}};
  split.uvs.clear();
  expect_counts(find_leaves(tree_of({split}), {}), {1, 4, 0});
}

TEST(LeafComponents, NegativeZeroIsZero) {
  Primitive halves;
  add_quad(halves, {Vec3f{-1, 0, 0}, {0.f, 0, 0}, {0.f, 1, 0}, {-1, 1, 0}});
  add_quad(halves, {Vec3f{-0.f, -0.f, 0}, {1, 0, 0}, {1, 1, -0.f}, {-0.f, 1, -0.f}});
  expect_counts(find_leaves(tree_of({halves}), {}), {1, 6, 0});
}

TEST(LeafComponents, PrimitivesAreNotWeldedTogether) {
  expect_counts(find_leaves(tree_of({card(1, 1), card(1, 1)}), {}), {2, 8, 0});
}

TEST(LeafComponents, CrossedCardsAreTwoLeavesWithTheirOwnVertices) {
  const LeafSet set = find_leaves(tree_of({crossed_cards()}), {});
  expect_counts(set, {2, 12, 1});
  for (const LeafVertex& vertex : set.vertices) {
    EXPECT_FLOAT_EQ(vertex.radius_major, 1 / std::sqrt(3.f));
    EXPECT_FLOAT_EQ(vertex.radius_minor, 1 / std::sqrt(3.f));
    EXPECT_NEAR(std::abs(vertex.normal.x) + std::abs(vertex.normal.y), 1, 1e-6);
  }
}

TEST(LeafComponents, CrossedCardsWithBackFacesAreTwoLeaves) {
  Primitive cards = crossed_cards();
  add_back_faces(cards);
  expect_counts(find_leaves(tree_of({cards}), {}), {2, 12, 1});
}

TEST(LeafComponents, CrossedCardsStayApartWhateverTheirWinding) {
  Primitive cards = crossed_cards();
  std::swap(cards.triangles[1][1], cards.triangles[1][2]);
  std::swap(cards.triangles[6][1], cards.triangles[6][2]);
  expect_counts(find_leaves(tree_of({cards}), {}), {2, 12, 1});
}

TEST(LeafComponents, DoubledFacesAreOneFlatLeaf) {
  Primitive leaf = card(2, 1);
  add_back_faces(leaf);
  const LeafSet set = find_leaves(tree_of({leaf}), {});
  expect_counts(set, {1, 4, 0});
  EXPECT_NEAR(std::abs(set.vertices[0].normal.z), 1, 1e-6);
  EXPECT_FLOAT_EQ(set.vertices[0].radius_major, 2 / std::sqrt(3.f));
}

TEST(LeafComponents, GentlyBentLeafStaysWhole) {
  // The halves are at 20 degrees to each other.
  const float rise = std::tan(10 * 3.14159265f / 180);
  expect_counts(find_leaves(tree_of({strip({{-1, rise}, {0, 0}, {1, rise}})}), {}), {1, 6, 0});
}

TEST(LeafComponents, SharpFoldIsSplit) {
  expect_counts(find_leaves(tree_of({strip({{-1, 1}, {0, 0}, {1, 1}})}), {}), {2, 8, 1});
}

TEST(LeafComponents, FortyFiveDegreesIsNotSharp) {
  // Three parts at 45 degrees to each other are not flat, so they are split into their triangles.
  const float d = std::sqrt(0.5f);
  const Primitive gutter = strip({{-1 - d, d}, {-1, 0}, {0, 0}, {d, d}});
  const Primitive steeper = strip({{-1 - d, 1.1f * d}, {-1, 0}, {0, 0}, {d, 1.1f * d}});
  expect_counts(find_leaves(tree_of({gutter}), {}), {6, 18, 1});
  expect_counts(find_leaves(tree_of({steeper}), {}), {3, 12, 1});
}

TEST(LeafComponents, CubeIsSixLeaves) {
  Primitive cube;
  for (int side = 0; side < 6; ++side) {
    const auto turned = [side](float a, float b) {
      const float c = side < 3 ? -1.f : 1.f;
      return side % 3 == 0 ? Vec3f{a, b, c} : side % 3 == 1 ? Vec3f{c, a, b} : Vec3f{b, c, a};
    };
    add_quad(cube, {turned(-1, -1), turned(1, -1), turned(1, 1), turned(-1, 1)});
  }
  expect_counts(find_leaves(tree_of({cube}), {}), {6, 24, 1});
}

TEST(LeafComponents, FrontAndBackOfASharpCornerAreOneLeaf) {
  Primitive tetrahedron;
  tetrahedron.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  tetrahedron.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  add_back_faces(tetrahedron);
  expect_counts(find_leaves(tree_of({tetrahedron}), {}), {4, 12, 1});
}

TEST(LeafComponents, ClosedCrownFallsIntoItsTriangles) {
  const Primitive crown = sphere(100);
  ASSERT_EQ(crown.triangles.size(), 80000u);
  expect_counts(find_leaves(tree_of({crown}), {}), {80000, 240000, 1});
}

TEST(LeafComponents, FrontAndBackOfATriangleStayOneLeaf) {
  Primitive crown = sphere(4);
  const std::size_t count = crown.triangles.size();
  add_back_faces(crown);
  expect_counts(find_leaves(tree_of({crown}), {}), {count, 3 * count, 1});
}

TEST(LeafComponents, FlatnessIsThatOfThePlacedLeaf) {
  TreeModel tree = tree_of({strip({{-1, 1}, {0, 0}, {1, 1}})});
  tree.instances[0].to_world[1][1] = 0.1;
  expect_counts(find_leaves(tree, {}), {1, 6, 0});
}

TEST(LeafComponents, DegenerateLeavesAreDroppedAndCounted) {
  Primitive leaves = card(1, 1);
  add_quad(leaves, {Vec3f{5, 0, 0}, {6, 0, 0}, {7, 0, 0}, {8, 0, 0}});
  add_quad(leaves, {Vec3f{9, 9, 9}, {9, 9, 9}, {9, 9, 9}, {9, 9, 9}});
  leaves.uvs.clear();
  const LeafSet set = find_leaves(tree_of({leaves}), {});
  EXPECT_EQ(set.leaf_count, 1u);
  EXPECT_EQ(set.vertices.size(), 4u);
  EXPECT_EQ(set.dropped_leaves, 2u);
  EXPECT_EQ(set.bounds.high.x, 0.5);
}

TEST(LeafComponents, OnlyLeavesWithValuesThatAreNotFiniteAreDropped) {
  Primitive leaves = card(1, 1);
  add_quad(leaves, {Vec3f{5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}});
  leaves.uvs.resize(8);
  leaves.normals.assign(8, {0, 0, 1});
  EXPECT_EQ(find_leaves(tree_of({leaves}), {}).leaf_count, 2u);
  for (const float value : {NAN, INFINITY}) {
    Primitive bad_uv = leaves, bad_normal = leaves;
    bad_uv.uvs[6].y = value;
    bad_normal.normals[6].x = value;
    for (const Primitive& bad : {bad_uv, bad_normal}) {
      const LeafSet set = find_leaves(tree_of({bad}), {});
      EXPECT_EQ(set.leaf_count, 1u);
      EXPECT_EQ(set.dropped_leaves, 1u);
      EXPECT_EQ(set.bounds.high.x, 0.5);
    }
  }
}

TEST(LeafComponents, PlacementsThatLeaveNoFiniteAreaAreDropped) {
  TreeModel tree = tree_of({card(1, 1)});
  for (const double scale : {0., 1e200, HUGE_VAL, double{NAN}}) {
    tree.instances.push_back({0, "node"});
    tree.instances.back().to_world[0][0] = scale;
  }
  tree.instances.push_back({0, "node"});
  tree.instances.back().to_world[2][3] = HUGE_VAL;
  const LeafSet set = find_leaves(tree, {});
  EXPECT_EQ(set.leaf_count, 1u);
  EXPECT_EQ(set.vertices.size(), 4u);
  EXPECT_EQ(set.dropped_leaves, 5u);
}

TEST(LeafComponents, NarrowLeafIsKept) {
  const LeafSet set = find_leaves(tree_of({card(1, 1e-5f)}), {});
  EXPECT_EQ(set.leaf_count, 1u);
  EXPECT_NEAR(set.vertices[0].radius_minor, 1e-5 / std::sqrt(3.), 1e-9);
}

TEST(LeafComponents, NothingUsableIsAnInputError) {
  TreeModel tree = tree_of({card(1, 0)});
  tree.path = "flat.glb";
  try {
    find_leaves(tree, {});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_NE(std::string(error.what()).find("the one leaf of flat.glb"), std::string::npos);
  }
}

}  // namespace
}  // namespace leafhull
