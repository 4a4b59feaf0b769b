// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "leaves_models.h"

namespace leafhull {
namespace {

using test::add_back_faces;
using test::alpha_image;
using test::card;
using test::masked;
using test::opaque_inside;
using test::tree_of;

const double kSqrt3 = std::sqrt(3.);

/// A regular hexagon of circumradius 1 in the x, y plane, as a fan around its centre.
Primitive hexagon() {
  Primitive primitive;
  primitive.positions.push_back({0, 0, 0});
  for (int i = 0; i < 6; ++i) {
    const double angle = i * std::numbers::pi / 3;
    primitive.positions.push_back({float(std::cos(angle)), float(std::sin(angle)), 0});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    primitive.triangles.push_back({0, 1 + i, 1 + (i + 1) % 6});
  }
  return primitive;
}

/// Expects every vertex of the set to have these radii.
void expect_radii(const LeafSet& set, double major, double minor, double tolerance = 1e-6) {
  ASSERT_FALSE(set.vertices.empty());
  for (const LeafVertex& vertex : set.vertices) {
    EXPECT_NEAR(vertex.radius_major, major, tolerance * major);
    EXPECT_NEAR(vertex.radius_minor, minor, tolerance * minor);
  }
}

/// Expects every u_j to be along `direction`, up to sign.
void expect_major(const LeafSet& set, const Vec3d& direction, double tolerance = 1e-6) {
  for (const LeafVertex& vertex : set.vertices) {
    EXPECT_NEAR(std::abs(dot(Vec3d(vertex.major), normalized(direction))), 1, tolerance);
  }
}

// A side a has variance a^2 / 12, so the half axis is a / sqrt 3.
TEST(TriangleEllipse, Quad) {
  const LeafSet set = find_leaves(tree_of({card(2, 1)}), {});
  expect_radii(set, 2 / kSqrt3, 1 / kSqrt3);
  expect_major(set, {1, 0, 0});
  EXPECT_NEAR(set.mean_radius_major, 2 / kSqrt3, 1e-6);
}

// A right triangle with legs a, b has variances a^2/18, b^2/18 and covariance -ab/36; with a = b =
// 1 the principal ones are 1/12 and 1/36.
TEST(TriangleEllipse, Triangle) {
  Primitive triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  const LeafSet set = find_leaves(tree_of({triangle}), {});
  expect_radii(set, 1 / kSqrt3, 1. / 3);
  expect_major(set, {1, -1, 0});
}

// A hexagon of circumradius 1 has variance 5/24 in every direction.
TEST(TriangleEllipse, HexagonStretched) {
  TreeModel tree = tree_of({hexagon()});
  tree.instances[0].to_world[1][1] = 3;
  const LeafSet set = find_leaves(tree, {});
  EXPECT_EQ(set.vertices.size(), 7u);
  expect_radii(set, 3 * std::sqrt(5. / 6), std::sqrt(5. / 6));
  expect_major(set, {0, 1, 0});
}

TEST(TriangleEllipse, DoesNotDependOnTheTriangulation) {
  Primitive uneven = card(2, 1);
  uneven.positions.push_back({0.7f, -0.2f, 0});
  uneven.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  uneven.uvs.clear();
  expect_radii(find_leaves(tree_of({uneven}), {}), 2 / kSqrt3, 1 / kSqrt3);
}

// The unit square sheared by 1 has the covariance (2 1; 1 1) / 12. Its eigenvalues are phi^2/12 and
// 1/(12 phi^2), and its first direction is phi x + y.
TEST(TriangleEllipse, ShearedInstance) {
  TreeModel tree = tree_of({card(1, 1)});
  tree.instances[0].to_world[0][1] = 1;
  const LeafSet set = find_leaves(tree, {});
  const double phi = std::numbers::phi;
  expect_radii(set, phi / kSqrt3, 1 / (phi * kSqrt3));
  expect_major(set, {phi, 1, 0});
}

TEST(TriangleEllipse, RotatedAndMirroredInstance) {
  TreeModel tree = tree_of({card(2, 1)});
  // x goes to -z, y to 2 x and z to y: this mirrors the card and doubles its height.
  tree.instances[0].to_world = {{{0, 2, 0, 7}, {0, 0, 1, 8}, {-1, 0, 0, 9}}};
  const LeafSet set = find_leaves(tree, {});
  expect_radii(set, 2 / kSqrt3, 2 / kSqrt3);
  for (const LeafVertex& vertex : set.vertices) EXPECT_NEAR(std::abs(vertex.normal.y), 1, 1e-6);
  EXPECT_EQ(set.bounds.low, Vec3d(6, 8, 8));
  EXPECT_EQ(set.bounds.high, Vec3d(8, 8, 10));
}

TEST(TriangleEllipse, FarFromTheOriginNothingChanges) {
  TreeModel near = tree_of({hexagon(), card(0.3f, 0.2f)});
  TreeModel far = near;
  for (Instance& instance : far.instances) {
    for (auto* tree : {&near, &far}) {
      auto& placed = tree->instances[static_cast<std::size_t>(&instance - far.instances.data())];
      placed.to_world = {{{0.6, -0.8, 0, 0}, {0.48, 0.36, -0.8, 0}, {0.64, 0.48, 0.6, 0}}};
    }
    instance.to_world[0][3] = 10000;
  }
  const LeafSet a = find_leaves(near, {});
  const LeafSet b = find_leaves(far, {});
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (std::size_t i = 0; i < a.vertices.size(); ++i) {
    EXPECT_NEAR(b.vertices[i].position.x - 10000, a.vertices[i].position.x, 1e-11);
    EXPECT_EQ(b.vertices[i].normal, a.vertices[i].normal);
    EXPECT_EQ(b.vertices[i].major, a.vertices[i].major);
    EXPECT_EQ(b.vertices[i].radius_major, a.vertices[i].radius_major);
  }
}

TEST(TriangleEllipse, LeafScaleMultipliesBothRadii) {
  const LeafSet set = find_leaves(tree_of({card(2, 1)}), test::with_scale(1.5));
  expect_radii(set, 3 / kSqrt3, 1.5 / kSqrt3);
  EXPECT_NEAR(set.mean_radius_major, 3 / kSqrt3, 1e-6);
}

// The second moment of a disc of radius r is r^2 / 4: two standard deviations are r.
TEST(MaskEllipse, DiscInPartOfACard) {
  const auto disc = opaque_inside(0.3, 0.6, 0.25, 0.25);
  const LeafSet set = find_leaves(masked(tree_of({card(2, 2)}), alpha_image(256, disc)), {});
  expect_radii(set, 0.5, 0.5, 2e-3);
}

TEST(MaskEllipse, FollowsTheCard) {
  const auto ellipse = opaque_inside(0.5, 0.5, 0.2, 0.4);
  const Image image = alpha_image(256, ellipse);
  LeafSet set = find_leaves(masked(tree_of({card(1, 1)}), image), {});
  expect_radii(set, 0.4, 0.2, 2e-3);
  expect_major(set, {0, 1, 0});
  // The card is so wide that the other axis becomes the longer one.
  set = find_leaves(masked(tree_of({card(4, 1)}), image), {});
  expect_radii(set, 0.8, 0.4, 2e-3);
  expect_major(set, {1, 0, 0});
}

// Texels are squares, not points: two standard deviations of a side are side / sqrt(3).
TEST(MaskEllipse, ATexelHasAnExtent) {
  const auto texels = [](int columns, int rows) {
    return [=](double u, double v) {
      return std::abs(8 * u - 4) * 2 < columns && std::abs(8 * v - 4) * 2 < rows ? 255 : 0;
    };
  };
  const auto leaf = [&](int columns, int rows) {
    return find_leaves(masked(tree_of({card(1, 1)}), alpha_image(8, texels(columns, rows))), {});
  };
  expect_radii(leaf(2, 2), 0.25 / std::numbers::sqrt3, 0.25 / std::numbers::sqrt3, 1e-6);
  expect_radii(leaf(2, 8), 1 / std::numbers::sqrt3, 0.25 / std::numbers::sqrt3, 1e-6);
}

TEST(MaskEllipse, SlantedMaskOnARotatedCard) {
  // The ellipse lies along u = v, which runs from the upper left to the lower right.
  const auto slanted = [](double u, double v) {
    const double along = (u - 0.5 + (v - 0.5)) / std::numbers::sqrt2;
    const double across = (u - 0.5 - (v - 0.5)) / std::numbers::sqrt2;
    return std::hypot(along / 0.4, across / 0.1) <= 1 ? 255 : 0;
  };
  TreeModel tree = masked(tree_of({card(1, 1)}), alpha_image(256, slanted));
  const LeafSet flat = find_leaves(tree, {});
  expect_radii(flat, 0.4, 0.1, 5e-3);
  expect_major(flat, {1, -1, 0}, 1e-4);
  tree.instances[0].to_world = {{{0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}};
  expect_major(find_leaves(tree, {}), {0, 1, -1}, 1e-4);
}

// Eqs. (5) and (6) map the diameters' end points to space. Sheared by 1 they are (0.4, 0) and
// (0.2, 0.2), no longer at right angles, and u_j is along the first.
TEST(MaskEllipse, ShearedCardKeepsTheDiametersLengths) {
  TreeModel tree =
      masked(tree_of({card(1, 1)}), alpha_image(256, opaque_inside(0.5, 0.5, 0.4, 0.2)));
  tree.instances[0].to_world[0][1] = 1;
  const LeafSet set = find_leaves(tree, {});
  expect_radii(set, 0.4, 0.2 * std::numbers::sqrt2, 2e-3);
  expect_major(set, {1, 0, 0});
}

TEST(MaskEllipse, OnlyTheLeafsOwnBoxCounts) {
  const auto atlas = [](double u, double v) {
    return u < 0.5 ? opaque_inside(0.25, 0.5, 0.2, 0.4)(u, v)
                   : opaque_inside(0.75, 0.5, 0.1, 0.2)(u, v);
  };
  Primitive right = card(1, 1);
  for (Vec2f& uv : right.uvs) uv.x = 0.5f + uv.x / 2;
  const LeafSet set = find_leaves(masked(tree_of({right}), alpha_image(256, atlas)), {});
  // The texture's part is half as wide as the card, so u counts twice.
  expect_radii(set, 0.2, 0.2, 5e-3);
}

/// The leaf of a card whose texture coordinates are shifted by (du, dv), under a wrap mode.
LeafSet shifted(float du, float dv, Wrap wrap, const std::function<int(double, double)>& alpha) {
  Primitive primitive = card(1, 1);
  for (Vec2f& uv : primitive.uvs) uv = {uv.x + du, uv.y + dv};
  TreeModel tree = masked(tree_of({primitive}), alpha_image(128, alpha));
  tree.materials[0].wrap_u = tree.materials[0].wrap_v = wrap;
  return find_leaves(tree, {});
}

TEST(MaskEllipse, WrapModes) {
  expect_radii(shifted(3, -2, Wrap::repeat, opaque_inside(0.3, 0.4, 0.2, 0.1)), 0.2, 0.1, 1e-2);
  // Shifted by half a tile, the quarters of a disc at the four corners form a whole disc.
  const auto quarters = [](double u, double v) {
    return opaque_inside(0, 0, 0.2, 0.1)(std::min(u, 1 - u), std::min(v, 1 - v));
  };
  expect_radii(shifted(-0.5f, 0.5f, Wrap::repeat, quarters), 0.2, 0.1, 1e-2);
  // Half a disc and its mirror image form a disc.
  const auto half = opaque_inside(1, 0.5, 0.2, 0.1);
  expect_radii(shifted(0.5f, 0, Wrap::mirror, half), 0.2, 0.1, 1e-2);
  // The last column is repeated beyond the border and forms a band as high as the disc.
  expect_radii(shifted(1, 0, Wrap::clamp, half), 1 / kSqrt3, 0.2 / kSqrt3, 2e-2);
}

TEST(MaskEllipse, CutoffAndBaseColourAlpha) {
  // The alpha is 140 inside the small disc and 110 in the ring around it.
  const auto rings = [](double u, double v) {
    const double r = std::hypot(u - 0.5, v - 0.5);
    return r <= 0.2 ? 140 : r <= 0.4 ? 110 : 0;
  };
  TreeModel tree = masked(tree_of({card(1, 1)}), alpha_image(256, rings));
  expect_radii(find_leaves(tree, {}), 0.2, 0.2, 5e-3);
  tree.materials[0].alpha_cutoff = 0.4;
  expect_radii(find_leaves(tree, {}), 0.4, 0.4, 5e-3);
  tree.materials[0].base_color[3] = 0.8f;
  expect_radii(find_leaves(tree, {}), 0.2, 0.2, 5e-3);
  // Blending has no cutoff; from one half on, texels count.
  tree.materials[0].alpha_mode = AlphaMode::blend;
  tree.materials[0].base_color[3] = 1;
  expect_radii(find_leaves(tree, {}), 0.2, 0.2, 5e-3);
}

TEST(MaskEllipse, CutoffIsInclusive) {
  TreeModel tree = masked(tree_of({card(1, 1)}),
                          alpha_image(64, [](double u, double) { return u < 0.5 ? 255 : 102; }));
  tree.materials[0].alpha_cutoff = 0.4;  // 102 / 255
  tree.images[0].rgba[3] = 0;            // otherwise there is no mask
  expect_radii(find_leaves(tree, {}), 1 / kSqrt3, 1 / kSqrt3, 1e-2);
}

TEST(MaskEllipse, WithoutAMaskTheTrianglesDecide) {
  const auto disc = opaque_inside(0.5, 0.5, 0.2, 0.2);
  const TreeModel cut = masked(tree_of({card(2, 1)}), alpha_image(64, disc));
  expect_radii(find_leaves(cut, {}), 0.4, 0.2, 3e-2);

  TreeModel opaque = cut;  // its image still has holes
  opaque.materials[0].alpha_mode = AlphaMode::opaque;
  const LeafSet said = find_leaves(opaque, {});
  expect_radii(said, 0.4, 0.2, 3e-2);
  EXPECT_EQ(said.warnings.size(), 1u);

  TreeModel missing = cut;
  missing.images[0] = {};
  TreeModel uncut = cut;
  uncut.images[0] = alpha_image(64, [](double, double) { return 200; });
  for (const TreeModel& tree : {missing, uncut}) {
    const LeafSet set = find_leaves(tree, {});
    expect_radii(set, 2 / kSqrt3, 1 / kSqrt3);
    EXPECT_TRUE(set.warnings.empty());
  }

  TreeModel no_uvs = cut;
  no_uvs.primitives[0].uvs.clear();
  TreeModel one_uv = cut;
  one_uv.primitives[0].uvs.assign(4, {0.5f, 0.5f});
  TreeModel line = cut;
  for (Vec2f& uv : line.primitives[0].uvs) uv.y = uv.x;
  TreeModel endless = cut;
  for (Vec2f& uv : endless.primitives[0].uvs) uv = {uv.x * 1e30f, uv.y * 1e30f};
  for (const TreeModel& tree : {no_uvs, one_uv, line, endless}) {
    const LeafSet set = find_leaves(tree, {});
    expect_radii(set, 2 / kSqrt3, 1 / kSqrt3);
    ASSERT_EQ(set.warnings.size(), 1u);
    EXPECT_EQ(set.warnings[0].find("1 leaf has no usable texture coordinates"), 0u);
  }

  TreeModel empty = cut;
  empty.images[0] = alpha_image(64, [](double, double) { return 0; });
  const LeafSet whole = find_leaves(empty, {});
  expect_radii(whole, 2 / kSqrt3, 1 / kSqrt3);
  ASSERT_EQ(whole.warnings.size(), 1u);
  EXPECT_NE(whole.warnings[0].find("transparent everywhere"), std::string::npos);
}

TEST(MaskEllipse, MirroredBackFacesDoNotSpoilTheMap) {
  Primitive leaf = card(1, 1);
  leaf.positions.insert(leaf.positions.end(), leaf.positions.begin(), leaf.positions.end());
  leaf.uvs.insert(leaf.uvs.end(), {{1, 1}, {0, 1}, {0, 0}, {1, 0}});
  leaf.triangles.push_back({4, 6, 5});
  leaf.triangles.push_back({4, 7, 6});
  const LeafSet set =
      find_leaves(masked(tree_of({leaf}), alpha_image(128, opaque_inside(0.5, 0.5, 0.4, 0.2))), {});
  EXPECT_EQ(set.leaf_count, 1u);
  EXPECT_EQ(set.split_components, 0u);
  expect_radii(set, 0.4, 0.2, 1e-2);
}

TEST(MaskEllipse, TextureThatDoesNotLieFlatSplitsTheLeaf) {
  // Four corners in a plane; the texture coordinates of one are far from an affine map.
  Primitive leaf = card(1, 1);
  leaf.uvs[2] = {0.1f, 0.9f};
  const auto disc = opaque_inside(0.5, 0.5, 0.4, 0.4);
  const LeafSet set = find_leaves(masked(tree_of({leaf}), alpha_image(64, disc)), {});
  EXPECT_EQ(set.split_components, 1u);
  EXPECT_EQ(set.leaf_count, 2u);
  EXPECT_EQ(find_leaves(tree_of({leaf}), {}).split_components, 0u);
}

TEST(GivenEllipse, GoesBeforeTheMask) {
  const TextureEllipse drawn{{0.5, 0.5}, {0.1, 0}, {0, 0.3}};
  const auto disc = opaque_inside(0.5, 0.5, 0.2, 0.2);
  const LeafSet set =
      find_leaves(masked(tree_of({card(2, 1)}), alpha_image(64, disc)), test::with_ellipse(drawn));
  expect_radii(set, 0.3, 0.2);
  expect_major(set, {0, 1, 0});
}

TEST(GivenEllipse, TakesEachLeafsOwnMap) {
  Primitive cards = card(2, 1);
  test::add_quad(cards, {Vec3f{9, 0, 0}, {9, 4, 0}, {9, 4, 4}, {9, 0, 4}});
  cards.uvs.insert(cards.uvs.end(), {{0, 1}, {1, 1}, {1, 0}, {0, 0}});
  const LeafSet set =
      find_leaves(tree_of({cards}), test::with_ellipse({{0, 0}, {0.5, 0}, {0, 0.25}}));
  ASSERT_EQ(set.leaf_count, 2u);
  for (const LeafVertex& vertex : set.vertices) {
    const bool second = vertex.position.x == 9;
    EXPECT_FLOAT_EQ(vertex.radius_major, second ? 2 : 1);
    EXPECT_FLOAT_EQ(vertex.radius_minor, second ? 1 : 0.25f);
    EXPECT_NEAR(std::abs(second ? vertex.major.y : vertex.major.x), 1, 1e-6);
  }
  EXPECT_DOUBLE_EQ(set.mean_radius_major, 1.5);
}

TEST(GivenEllipse, WithoutTextureCoordinatesTheTrianglesDecideAndAWarningSaysSo) {
  Primitive bare = card(2, 1);
  bare.uvs.clear();
  const LeafSet set =
      find_leaves(tree_of({bare}), test::with_ellipse({{0, 0}, {0.5, 0}, {0, 0.25}}));
  expect_radii(set, 2 / kSqrt3, 1 / kSqrt3);
  EXPECT_EQ(set.warnings.size(), 1u);
}

}  // namespace
}  // namespace leafhull
