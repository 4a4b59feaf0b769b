// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "leaves_models.h"

namespace leafhull {
namespace {

using test::card;
using test::tree_of;

/// The vertex of the set at that position.
LeafVertex at(const LeafSet& set, const Vec3d& position) {
  for (const LeafVertex& vertex : set.vertices) {
    if (length(vertex.position - position) < 1e-6) return vertex;
  }
  ADD_FAILURE() << "no vertex there";
  return {};
}

/// Expects the two to agree up to sign.
void expect_axis(const Vec3f& axis, const Vec3d& expected) {
  EXPECT_NEAR(std::abs(dot(Vec3d(axis), normalized(expected))), 1, 1e-6)
      << axis.x << " " << axis.y << " " << axis.z;
}

/// Expects unit, orthogonal axes and R_u >= R_v > 0.
void expect_frames(const LeafSet& set) {
  for (const LeafVertex& vertex : set.vertices) {
    EXPECT_NEAR(length(vertex.normal), 1, 1e-6);
    EXPECT_NEAR(length(vertex.major), 1, 1e-6);
    EXPECT_NEAR(dot(vertex.normal, vertex.major), 0, 1e-6);
    EXPECT_GE(vertex.radius_major, vertex.radius_minor);
    EXPECT_GT(vertex.radius_minor, 0);
  }
}

const Vec3d kCorner{1, 0.5, 0};

TEST(LeafFrame, StoredNormalsTurnTheFrame) {
  Primitive leaf = card(2, 1);
  leaf.normals = {{0, 0, 1}, {0, 0, 1}, {0.6f, 0, 0.8f}, {0, 0.6f, 0.8f}};
  const LeafSet set = find_leaves(tree_of({leaf}), {});
  expect_frames(set);
  const LeafVertex slanted = at(set, kCorner);
  expect_axis(slanted.normal, {0.6, 0, 0.8});
  expect_axis(slanted.major, {0.8, 0, -0.6});
  const LeafVertex other = at(set, {-1, 0.5, 0});
  expect_axis(other.normal, {0, 0.6, 0.8});
  expect_axis(other.major, {1, 0, 0});
}

TEST(LeafFrame, MeanOfTheDistinctNormalsTakenUpToSign) {
  // One corner has the normal (0.6, 0, 0.8) on both sides and (0, 0, 1); each counts once.
  Primitive leaf = card(2, 1);
  leaf.normals.assign(4, {0, 0, 1});
  leaf.normals[2] = {0.6f, 0, 0.8f};
  leaf.positions.insert(leaf.positions.end(), leaf.positions.begin(), leaf.positions.end());
  leaf.normals.insert(leaf.normals.end(), {{0, 0, -1}, {0, 0, -1}, {-0.6f, 0, -0.8f}, {0, 0, -1}});
  leaf.triangles.push_back({4, 6, 5});
  leaf.triangles.push_back({4, 7, 6});
  leaf.positions.push_back(leaf.positions[2]);
  leaf.normals.push_back({0, 0, 1});
  leaf.triangles[1] = {0, 8, 3};
  leaf.uvs.clear();
  const LeafSet set = find_leaves(tree_of({leaf}), {});
  ASSERT_EQ(set.vertices.size(), 4u);
  expect_frames(set);
  expect_axis(at(set, kCorner).normal, {0.6, 0, 1.8});
  expect_axis(at(set, {-1, 0.5, 0}).normal, {0, 0, 1});
}

TEST(LeafFrame, NormalsGoByTheInverseTranspose) {
  Primitive leaf = card(1, 1);
  leaf.normals.assign(4, {0.6f, 0, 0.8f});
  TreeModel tree = tree_of({leaf});
  tree.instances[0].to_world = {{{-2, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, 1, 0}}};
  const LeafSet set = find_leaves(tree, {});
  expect_frames(set);
  for (const LeafVertex& vertex : set.vertices) expect_axis(vertex.normal, {-0.3, 0, 0.8});
}

// A shallow gutter along y: a unit square on the right and half of one on the left. The winding of
// the triangles does not matter.
TEST(LeafFrame, WithoutNormalsTheFacesDecideByArea) {
  Primitive leaf;
  leaf.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0.1f}, {1, 1, 0.1f}, {-1, 0, 0.1f}};
  leaf.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 4}};
  for (std::size_t reversed = 0; reversed < 4; ++reversed) {
    Primitive wound = leaf;
    if (reversed < 3) std::swap(wound.triangles[reversed][1], wound.triangles[reversed][2]);
    const LeafSet set = find_leaves(tree_of({wound}), {});
    ASSERT_EQ(set.leaf_count, 1u);
    expect_frames(set);
    expect_axis(at(set, {1, 0, 0.1f}).normal, {-0.1f, 0, 1});
    expect_axis(at(set, {-1, 0, 0.1f}).normal, {0.1f, 0, 1});
    // The right side has two of the three triangles at the origin and one of two at (0, 1, 0).
    expect_axis(at(set, {0, 0, 0}).normal, {-0.1f, 0, 3});
    expect_axis(at(set, {0, 1, 0}).normal, {0, 0, 1});
  }
}

TEST(LeafFrame, UnusableNormalsGiveWayToTheFaces) {
  Primitive leaf = card(1, 1);
  leaf.normals.assign(4, {0.6f, 0, 0.8f});
  leaf.normals[2] = {0, 0, 0};
  const LeafSet set = find_leaves(tree_of({leaf}), {});
  ASSERT_EQ(set.vertices.size(), 4u);
  expect_frames(set);
  expect_axis(at(set, {0.5, 0.5, 0}).normal, {0, 0, 1});
  expect_axis(at(set, {-0.5, 0.5, 0}).normal, {0.6, 0, 0.8});
}

TEST(LeafFrame, NormalAlongTheMajorAxis) {
  Primitive leaf = card(2, 1);
  leaf.normals.assign(4, {1, 0, 0});
  const LeafSet set = find_leaves(tree_of({leaf}), {});
  ASSERT_EQ(set.vertices.size(), 4u);
  expect_frames(set);
  // The minor axis stays v, so u is the remaining direction.
  for (const LeafVertex& vertex : set.vertices) {
    expect_axis(vertex.normal, {1, 0, 0});
    expect_axis(vertex.major, {0, 0, 1});
  }
}

}  // namespace
}  // namespace leafhull
