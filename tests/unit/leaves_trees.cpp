// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {
namespace {

/// An ellipse in fractions of a card's sides, measured right and down from the upper left corner.
struct CardEllipse {
  Vec2d major, minor;
};

/// Two standard deviations of the kept texels along their principal directions, for a card that
/// shows the whole image once. The angle of a covariance's first axis is atan2(2 cov(u, v), var(u)
/// - var(v)) / 2.
CardEllipse ellipse_of_mask(const Image& image, double cutoff) {
  double count = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t texel = std::size_t(y) * std::size_t(image.width) + std::size_t(x);
      if (image.rgba[4 * texel + 3] < cutoff * 255) continue;
      const Vec2d p{(x + 0.5) / image.width, (y + 0.5) / image.height};
      count += 1;
      u += p.x;
      v += p.y;
      uu += p.x * p.x;
      uv += p.x * p.y;
      vv += p.y * p.y;
    }
  }
  uu = uu / count - u * u / count / count;
  uv = uv / count - u * v / count / count;
  vv = vv / count - v * v / count / count;
  const double angle = std::atan2(2 * uv, uu - vv) / 2;
  const double spread = std::hypot((uu - vv) / 2, uv);
  const double major = 2 * std::sqrt((uu + vv) / 2 + spread);
  const double minor = 2 * std::sqrt((uu + vv) / 2 - spread);
  return {{major * std::cos(angle), major * std::sin(angle)},
          {-minor * std::sin(angle), minor * std::cos(angle)}};
}

class Ash : public ::testing::Test {
 protected:
  /// The sides of a card from its upper left corner.
  struct Card {
    Vec3d right, down;
  };

  const TreeModel tree_ = read_tree(std::filesystem::path(LEAFHULL_EXAMPLES) / "ash.glb");
  const LeafSet leaves_ = find_leaves(tree_, {});

  const Primitive& primitive() const {
    return *std::ranges::find(tree_.primitives, "leaves", &Primitive::mesh_name);
  }

  /// The card of every leaf vertex. Its corners are stored as lower left, upper left, upper right
  /// and lower right.
  std::vector<Card> cards_of_vertices() const {
    using Position = std::array<float, 3>;
    std::map<Position, Card> cards;
    const std::vector<Vec3f>& p = primitive().positions;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const std::size_t first = i / 4 * 4;
      cards[{p[i].x, p[i].y, p[i].z}] = {Vec3d(p[first + 2]) - Vec3d(p[first + 1]),
                                         Vec3d(p[first]) - Vec3d(p[first + 1])};
    }
    std::vector<Card> of_vertices;
    for (const LeafVertex& vertex : leaves_.vertices) {
      const Vec3f at(vertex.position);
      of_vertices.push_back(cards.at({at.x, at.y, at.z}));
    }
    return of_vertices;
  }
};

TEST_F(Ash, EveryCardIsALeaf) {
  EXPECT_EQ(leaves_.leaf_count, 5440u);
  EXPECT_EQ(leaves_.vertices.size(), 21760u);
  EXPECT_EQ(leaves_.dropped_leaves, 0u);
  EXPECT_EQ(leaves_.split_components, 0u);
  EXPECT_TRUE(leaves_.warnings.empty());
}

TEST_F(Ash, EllipseFollowsTheBranchletInTheTexture) {
  const Material& material = tree_.materials[std::size_t(primitive().material)];
  const CardEllipse drawn =
      ellipse_of_mask(tree_.images[std::size_t(material.base_color_image)], material.alpha_cutoff);
  const std::vector<Card> cards = cards_of_vertices();
  for (std::size_t i = 0; i < leaves_.vertices.size(); ++i) {
    const LeafVertex& vertex = leaves_.vertices[i];
    const auto& [right, down] = cards[i];
    const Vec3d major = right * drawn.major.x + down * drawn.major.y;
    const Vec3d minor = right * drawn.minor.x + down * drawn.minor.y;
    ASSERT_NEAR(vertex.radius_major, length(major), 1e-4 * length(major));
    ASSERT_NEAR(vertex.radius_minor, length(minor), 1e-4 * length(minor));
    ASSERT_NEAR(std::abs(dot(Vec3d(vertex.major), normalized(major))), 1, 1e-5);
  }
}

// The branchlet does not fill the square card and is longer than wide. The ellipse of the whole
// card would have two half axes of 1 / sqrt 3 of its side.
TEST_F(Ash, EllipseIsNotTheCards) {
  const std::vector<Card> cards = cards_of_vertices();
  for (std::size_t i = 0; i < leaves_.vertices.size(); ++i) {
    const double of_card = length(cards[i].right) / std::sqrt(3.);
    ASSERT_NEAR(length(cards[i].down), length(cards[i].right), 1e-3 * of_card);
    ASSERT_LT(leaves_.vertices[i].radius_major, 0.8 * of_card);
    ASSERT_LT(leaves_.vertices[i].radius_minor, 0.5 * of_card);
  }
}

struct SharedTree {
  const char* file;
  std::size_t leaves, vertices, touching;
};

class SharedTrees : public ::testing::TestWithParam<SharedTree> {};

// Leaves of one primitive that share a position and lie in one plane become one leaf. This may cost
// at most `touching` vertices.
TEST_P(SharedTrees, LeavesAreFound) {
  const auto& [file, leaves, vertices, touching] = GetParam();
  const std::filesystem::path path = std::filesystem::path(LEAFHULL_SHARED_TREES) / file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "NOT TESTED: there is no " << path;
  const LeafSet set = find_leaves(read_tree(path), {});
  EXPECT_LE(set.leaf_count, leaves);
  EXPECT_GE(set.leaf_count + touching, leaves);
  EXPECT_LE(set.vertices.size(), vertices);
  EXPECT_GE(set.vertices.size() + touching, vertices);
  EXPECT_EQ(set.dropped_leaves, 0u);
  for (const LeafVertex& vertex : set.vertices) {
    ASSERT_NEAR(length(vertex.normal), 1, 1e-5);
    ASSERT_NEAR(dot(vertex.normal, vertex.major), 0, 1e-5);
    ASSERT_GE(vertex.radius_major, vertex.radius_minor);
    ASSERT_GT(vertex.radius_minor, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SharedTrees,
                         ::testing::Values(SharedTree{"bush.glb", 2496, 9984, 0},
                                           SharedTree{"aspen-52648.glb", 13162, 52648, 0},
                                           SharedTree{"birch.glb", 9459, 56754, 20},
                                           SharedTree{"callistemon.glb", 4794, 28764, 5}),
                         [](const auto& tree) {
                           const std::string file = tree.param.file;
                           return file.substr(0, file.find_first_of("-."));
                         });

}  // namespace
}  // namespace leafhull
