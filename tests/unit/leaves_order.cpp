// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "leaves/sheets.h"
#include "leaves_models.h"

namespace leafhull {
namespace {

using test::add_quad;
using test::card;
using test::tree_of;

using Random = std::mt19937;

Vec3f random_point(Random& random, float extent) {
  std::uniform_real_distribution<float> any(-extent, extent);
  const float x = any(random);
  const float y = any(random);
  return {x, y, any(random)};
}

/// Slanted cards with normals and texture coordinates; some are crumpled enough to be split.
Primitive crown(Random& random, int leaves) {
  Primitive primitive;
  for (int i = 0; i < leaves; ++i) {
    const Vec3f corner = random_point(random, 10);
    const Vec3f a = random_point(random, 1);
    const Vec3f b = random_point(random, 1);
    const Vec3f bend = random_point(random, i % 3 == 0 ? 1.f : 0.01f);
    add_quad(primitive, {corner, corner + a, corner + a + b + bend, corner + b});
    for (int n = 0; n < 4; ++n) primitive.normals.push_back(random_point(random, 1));
    primitive.uvs.insert(primitive.uvs.end(), {{0, 1}, {1, 1}, {1, 0}, {0, 0}});
  }
  return primitive;
}

TreeModel crowns(Random& random) {
  TreeModel tree = tree_of({crown(random, 40), crown(random, 40), crown(random, 40)});
  tree.instances.push_back({1, "again"});
  tree.instances.back().to_world[0][1] = 0.5;
  return test::masked(std::move(tree),
                      test::alpha_image(32, test::opaque_inside(0.5, 0.5, 0.4, 0.3)));
}

/// Gives every corner its own vertex.
void split_vertices(Primitive& primitive) {
  Primitive split;
  split.mesh_name = primitive.mesh_name;
  split.material = primitive.material;
  for (const auto& triangle : primitive.triangles) {
    const auto first = static_cast<std::uint32_t>(split.positions.size());
    for (const std::uint32_t vertex : triangle) {
      split.positions.push_back(primitive.positions[vertex]);
      split.normals.push_back(primitive.normals[vertex]);
      split.uvs.push_back(primitive.uvs[vertex]);
    }
    split.triangles.push_back({first, first + 1, first + 2});
  }
  primitive = std::move(split);
}

void shuffle_vertices(Primitive& primitive, Random& random) {
  std::vector<std::uint32_t> place(primitive.positions.size());
  for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
  std::ranges::shuffle(place, random);
  Primitive shuffled = primitive;
  for (std::size_t i = 0; i < place.size(); ++i) {
    shuffled.positions[place[i]] = primitive.positions[i];
    shuffled.normals[place[i]] = primitive.normals[i];
    shuffled.uvs[place[i]] = primitive.uvs[i];
  }
  for (auto& triangle : shuffled.triangles) {
    for (std::uint32_t& vertex : triangle) vertex = place[vertex];
  }
  primitive = std::move(shuffled);
}

void shuffle_triangles(Primitive& primitive, Random& random) {
  std::ranges::shuffle(primitive.triangles, random);
  for (auto& triangle : primitive.triangles) {
    std::ranges::rotate(triangle, triangle.begin() + random() % 3);
  }
}

void reverse_primitives(TreeModel& tree) {
  std::ranges::reverse(tree.primitives);
  std::ranges::reverse(tree.instances);
  for (Instance& instance : tree.instances) {
    instance.primitive =
        static_cast<std::uint32_t>(tree.primitives.size()) - 1 - instance.primitive;
  }
}

/// Expects the sets to be exactly equal, field by field.
void expect_equal(const LeafSet& a, const LeafSet& b) {
  EXPECT_EQ(a.leaf_count, b.leaf_count);
  EXPECT_EQ(a.dropped_leaves, b.dropped_leaves);
  EXPECT_EQ(a.split_components, b.split_components);
  EXPECT_EQ(a.mean_radius_major, b.mean_radius_major);
  EXPECT_EQ(a.bounds.low, b.bounds.low);
  EXPECT_EQ(a.bounds.high, b.bounds.high);
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    ASSERT_EQ(a.vertices[i].position, b.vertices[i].position) << i;
    ASSERT_EQ(a.vertices[i].normal, b.vertices[i].normal) << i;
    ASSERT_EQ(a.vertices[i].major, b.vertices[i].major) << i;
    ASSERT_EQ(a.vertices[i].radius_major, b.vertices[i].radius_major) << i;
    ASSERT_EQ(a.vertices[i].radius_minor, b.vertices[i].radius_minor) << i;
    ASSERT_EQ(a.vertices[i].leaf, b.vertices[i].leaf) << i;
  }
}

class LeafOrder : public ::testing::TestWithParam<unsigned> {};

TEST_P(LeafOrder, HowTheFileStoresTheLeavesChangesNoBit) {
  Random random(GetParam());
  const TreeModel tree = crowns(random);
  const LeafSet expected = find_leaves(tree, {});
  ASSERT_GT(expected.split_components, 10u);
  ASSERT_GT(expected.leaf_count, 160u);

  TreeModel split = tree;
  for (Primitive& primitive : split.primitives) split_vertices(primitive);
  expect_equal(find_leaves(split, {}), expected);

  TreeModel shuffled = tree;
  for (Primitive& primitive : shuffled.primitives) {
    shuffle_vertices(primitive, random);
    shuffle_triangles(primitive, random);
  }
  expect_equal(find_leaves(shuffled, {}), expected);

  TreeModel reversed = tree;
  reverse_primitives(reversed);
  expect_equal(find_leaves(reversed, {}), expected);
}

/// Cuts a crown into primitives of this many quads.
std::vector<Primitive> cut_up(const Primitive& whole, std::size_t leaves) {
  std::vector<Primitive> parts;
  for (std::size_t first = 0; first < whole.positions.size(); first += 4) {
    if (first % (4 * leaves) == 0) parts.emplace_back();
    Primitive& part = parts.back();
    add_quad(part, {whole.positions[first], whole.positions[first + 1], whole.positions[first + 2],
                    whole.positions[first + 3]});
    for (std::size_t i = first; i < first + 4; ++i) {
      part.normals.push_back(whole.normals[i]);
      part.uvs.push_back(whole.uvs[i]);
    }
  }
  return parts;
}

TEST_P(LeafOrder, OnePrimitiveOrManyIsTheSame) {
  Random random(GetParam());
  const Primitive whole = crown(random, 30);
  const std::vector<Primitive> parts = cut_up(whole, 1);
  ASSERT_EQ(parts.size(), 30u);
  expect_equal(find_leaves(tree_of(parts), {}), find_leaves(tree_of({whole}), {}));
}

void expect_equal_sheets(const LeafSheets& a, const LeafSheets& b) {
  EXPECT_EQ(a.area, b.area);
  EXPECT_EQ(a.charts.size(), b.charts.size());
  ASSERT_EQ(a.sheets.size(), b.sheets.size());
  for (std::size_t i = 0; i < a.sheets.size(); ++i) {
    ASSERT_EQ(a.sheets[i].origin, b.sheets[i].origin) << i;
    ASSERT_EQ(a.sheets[i].area, b.sheets[i].area) << i;
    ASSERT_EQ(a.sheets[i].piece, b.sheets[i].piece) << i;
    ASSERT_EQ(a.charts[a.sheets[i].chart].triangles, b.charts[b.sheets[i].chart].triangles) << i;
  }
}

// There are more leaves than are collected at a time, by several threads.
TEST(LeafOrder, ManyLeavesInOnePrimitiveOrInSeveralAreTheSame) {
  Random random(9);
  const Primitive whole = crown(random, 20'000);
  const LeafSet expected = find_leaves(tree_of({whole}), {});
  const LeafSet leaves = find_leaves(tree_of(cut_up(whole, 700)), {});
  expect_equal(leaves, expected);
  expect_equal_sheets(*leaves.sheets, *expected.sheets);
  EXPECT_EQ(leaves.order_in_file.size(), expected.order_in_file.size());
}

/// Closed octahedra, which are solids.
Primitive balls(Random& random, int count) {
  Primitive primitive;
  for (int i = 0; i < count; ++i) {
    const Vec3f middle = random_point(random, 10);
    const auto first = static_cast<std::uint32_t>(primitive.positions.size());
    for (const Vec3f d : {Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, 0, 1}}) {
      primitive.positions.push_back(middle + d);
      primitive.positions.push_back(middle - d);
    }
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      const std::uint32_t x = first + (corner & 1), y = first + 2 + (corner >> 1 & 1),
                          z = first + 4 + (corner >> 2 & 1);
      const bool is_even = std::popcount(corner) % 2 == 0;
      primitive.triangles.push_back(is_even ? std::array{x, y, z} : std::array{x, z, y});
    }
  }
  return primitive;
}

// There are more leaves (textured, some of them split) and solids than are collected at a time.
TEST(LeafOrder, ThreadsDoNotShow) {
  Random random(11);
  const TreeModel tree =
      test::masked(tree_of({crown(random, 12'000), balls(random, 9'000)}),
                   test::alpha_image(32, test::opaque_inside(0.5, 0.5, 0.4, 0.3)));
  const LeafOptions all = test::with_globs({"*"});
  const LeafSet many = find_leaves(tree, all);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const LeafSet few = find_leaves(tree, all);
  expect_equal(many, few);
  expect_equal_sheets(*many.sheets, *few.sheets);
  ASSERT_EQ(many.sheets->solids.size(), 9'000u);
  for (std::size_t i = 0; i < many.sheets->solids.size(); ++i) {
    ASSERT_EQ(many.sheets->solids[i].area, few.sheets->solids[i].area) << i;
    ASSERT_EQ(many.sheets->solids[i].triangles, few.sheets->solids[i].triangles) << i;
  }
}

// The leaves of one frame are found with the choice made in another.
TEST(LeafOrder, VerticesThatHaveMovedAreWeldedAnew) {
  Random random(7);
  const TreeModel rest = tree_of({crown(random, 50)});
  const LeafChoice choice = choose_leaves(rest, {});
  TreeModel moved = rest;
  std::vector<Vec3f>& positions = moved.primitives[0].positions;
  for (std::size_t i = 0; i < positions.size(); i += 8) positions[i] = positions[(i + 4) % 200];
  expect_equal(find_leaves(moved, choice, {}), find_leaves(moved, {}));
  positions.push_back({0, 0, 20});  // one more vertex than was welded
  moved.primitives[0].normals.push_back({0, 0, 1});
  moved.primitives[0].uvs.push_back({0, 0});
  expect_equal(find_leaves(moved, choice, {}), find_leaves(moved, {}));
}

INSTANTIATE_TEST_SUITE_P(Seeds, LeafOrder, ::testing::Values(1u, 2u, 3u, 4u));

// Neighbouring squares of one size share corners that differ only in the leaf.
TEST(LeafOrder, LeavesThatShareEqualVerticesKeepTheirNumbers) {
  std::vector<Primitive> squares;
  for (int i = 0; i < 4; ++i) {
    Primitive square;
    const float x = float(i % 2);
    const float y = float(i / 2);
    add_quad(square, {Vec3f{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}});
    squares.push_back(square);
  }
  const LeafSet expected = find_leaves(tree_of(squares), {});
  ASSERT_EQ(expected.vertices.size(), 16u);
  std::vector<int> order{0, 1, 2, 3};
  while (std::ranges::next_permutation(order).found) {
    std::vector<Primitive> permuted;
    for (const int i : order) permuted.push_back(squares[i]);
    expect_equal(find_leaves(tree_of(permuted), {}), expected);
  }
}

TEST(LeafOrder, NumbersGoByFirstAppearance) {
  Random random(5);
  std::uint32_t next = 0;
  const LeafSet set = find_leaves(crowns(random), {});
  for (const LeafVertex& vertex : set.vertices) {
    ASSERT_LE(vertex.leaf, next);
    next = std::max(next, vertex.leaf + 1);
  }
  EXPECT_EQ(next, set.leaf_count);
}

TEST(LeafOrder, ALeafIsKnownByItsPlaceInTheFileWhereverItMoves) {
  Random random(3);
  TreeModel tree = tree_of({crown(random, 60)});
  const auto places = [&] {
    // A corner of each leaf, in the order of the file.
    LeafOptions every;
    every.globs = {"*"};
    const LeafSet leaves = find_leaves(tree, every);
    EXPECT_EQ(leaves.order_in_file.size(), leaves.leaf_count);
    std::vector<Vec3d> lowest(leaves.leaf_count, Vec3d{1e9, 1e9, 1e9});
    for (const LeafVertex& v : leaves.vertices) {
      Vec3d& low = lowest[leaves.order_in_file[v.leaf]];
      if (v.position.x < low.x) low = v.position;
    }
    return lowest;
  };
  const std::vector<Vec3d> before = places();
  // Upside down, the leaves are sorted quite differently.
  for (Instance& instance : tree.instances) {
    for (double& value : instance.to_world[1]) value = -value;
  }
  const std::vector<Vec3d> after = places();
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i], Vec3d(after[i].x, -after[i].y, after[i].z)) << i;
  }
}

// The eight corners of a unit cube come in an order with x fastest and z slowest.
TEST(LeafOrder, FollowsTheMortonCurve) {
  Primitive corners;
  for (int i = 7; i >= 0; --i) {
    const auto side = [](int bit) { return bit ? 1.f : 0.f; };
    const Vec3f p{side(i & 1), side(i & 2), side(i & 4)};
    const auto inward = [](float x) { return x < 0.5f ? 1e-3f : -1e-3f; };
    const auto first = static_cast<std::uint32_t>(corners.positions.size());
    corners.positions.insert(corners.positions.end(),
                             {p, p + Vec3f{inward(p.x), 0, 0}, p + Vec3f{0, inward(p.y), 0}});
    corners.triangles.push_back({first, first + 1, first + 2});
  }
  const LeafSet set = find_leaves(tree_of({corners}), {});
  ASSERT_EQ(set.vertices.size(), 24u);
  for (int i = 0; i < 24; ++i) {
    const Vec3d& p = set.vertices[i].position;
    const int octant = (p.x > 0.5) + 2 * (p.y > 0.5) + 4 * (p.z > 0.5);
    EXPECT_EQ(octant, i / 3);
    EXPECT_EQ(set.vertices[i].leaf, std::uint32_t(i / 3));
  }
}

}  // namespace
}  // namespace leafhull
