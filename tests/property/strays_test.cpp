// SPDX-License-Identifier: Apache-2.0
// A few leaves far from a tree change nothing visible.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "leafhull/error.h"
#include "leafhull/render.h"
#include "leafhull/sweep.h"
#include "property/area_measures.h"
#include "property/extractions.h"
#include "render/buffers.h"
#include "tiles/level.h"

namespace leafhull {
namespace {

using test::device;
using test::volume;

using TreePointer = std::shared_ptr<const TreeModel>;

TreePointer shared_ash() {
  static const auto tree = std::make_shared<const TreeModel>(
      read_tree(std::filesystem::path(LEAFHULL_EXAMPLES) / "ash.glb"));
  return tree;
}

/// The tree with copies of some leaf cards, `crowns` crown heights away.
TreePointer with_strays(const TreeModel& tree, std::size_t count, Vec3d crowns) {
  auto changed = std::make_shared<TreeModel>(tree);
  const double height = find_leaves(tree, {}).crown.size().y;
  for (Primitive& leaves : changed->primitives) {
    if (leaves.mesh_name != "leaves") continue;
    const std::size_t cards = leaves.positions.size() / 4;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t card = 4 * (i * (cards / count));
      const auto first = static_cast<std::uint32_t>(leaves.positions.size());
      for (std::size_t corner = card; corner < card + 4; ++corner) {
        leaves.positions.push_back(leaves.positions[corner] + Vec3f(crowns * height));
        leaves.normals.push_back(leaves.normals[corner]);
        leaves.uvs.push_back(leaves.uvs[corner]);
      }
      leaves.triangles.push_back({first, first + 1, first + 2});
      leaves.triangles.push_back({first, first + 2, first + 3});
    }
  }
  return changed;
}

class Strays : public testing::TestWithParam<Vec3d> {
 protected:
  static constexpr std::size_t kCount = 20;
  const TreePointer tree_ = shared_ash(),
                    littered_ = with_strays(*shared_ash(), kCount, GetParam());
  const LeafSet leaves_ = find_leaves(*tree_, {}), all_ = find_leaves(*littered_, {});
};

INSTANTIATE_TEST_SUITE_P(Places, Strays,
                         testing::Values(Vec3d(3, 0, 0), Vec3d(0, -3, 0), Vec3d(-40, 2, 9)));

TEST_P(Strays, AreSaid) {
  EXPECT_TRUE(leaves_.warnings.empty());
  ASSERT_EQ(all_.warnings.size(), 1u);
  EXPECT_NE(all_.warnings[0].find("20 leaves lie far from the crown"), std::string::npos)
      << all_.warnings[0];
  EXPECT_EQ(all_.stray_leaves, kCount);
  EXPECT_EQ(all_.leaf_count, leaves_.leaf_count + kCount);
}

TEST_P(Strays, KeepTheCrownUnitTheVoxelsAndTheVolume) {
  const Options options;  // the style is painterly
  const Shape plain = extract(leaves_, options, device());
  const Shape littered = extract(all_, options, device());
  EXPECT_EQ(littered.report.radius_max_model, plain.report.radius_max_model);
  EXPECT_EQ(littered.report.voxel_size, plain.report.voxel_size);
  EXPECT_EQ(littered.report.resolution, plain.report.resolution);
  EXPECT_EQ(littered.report.threshold, plain.report.threshold);
  EXPECT_NEAR(volume(littered.mesh) / volume(plain.mesh), 1, 0.001);
}

TEST_P(Strays, KeepTheVoxelsOfAForest) {
  const Options options = resolve({});
  const std::vector<ModelUse> uses{{.trees = 1, .largest = 1, .smallest_volume = 1}};
  const std::vector shapes{options};
  EXPECT_EQ(voxel_size_of(std::vector{all_}, uses, shapes),
            voxel_size_of(std::vector{leaves_}, uses, shapes));
}

TEST_P(Strays, AreNotInTheFrame) {
  Box plain, littered;
  for (const Vec3d p : frame_of(leaves_, 1).points) plain.include(p);
  for (const Vec3d p : frame_of(all_, 1).points) littered.include(p);
  EXPECT_EQ(littered.low, plain.low);
  EXPECT_EQ(littered.high, plain.high);

  Options options;
  options.preset = Preset::draft;
  PictureOptions picture;
  picture.width = picture.height = 200;
  picture.camera = Viewpoint::front;
  for (const Surfacing surfacing : {Surfacing::direct, Surfacing::mesh}) {
    const auto seen = [&](const TreePointer& tree, const LeafSet& leaves) {
      return draw(tree_subject(tree, leaves, options, surfacing, device()), picture, device())
          .buffers;
    };
    const auto a = seen(tree_, leaves_), b = seen(littered_, all_);
    EXPECT_EQ(b->eye, a->eye);
    std::size_t covered = 0, other = 0;
    for (std::size_t i = 0; i < a->size(); ++i) {
      covered += a->object[i] != render::Object::paper;
      other += a->object[i] != b->object[i];
    }
    EXPECT_GT(covered, a->size() / 6);
    EXPECT_LT(static_cast<double>(other), 0.02 * static_cast<double>(covered));
  }
}

TEST_P(Strays, LeaveNoRoomInSuggestions) {
  Options options;
  options.preset = Preset::paper_32;
  const auto share = [&](const LeafSet& leaves) {
    return suggest(leaves, options, device(), "ash", {}).choices.back().dilated_share.value();
  };
  EXPECT_NEAR(share(all_) / share(leaves_), 1, 0.05);
}

TEST(FarStrays, KeepTheShapeAsFarAsTheLatticeCounts) {
  const auto shape_with = [&](double crowns) {
    return extract(find_leaves(*with_strays(*shared_ash(), 20, {0, crowns, 0}), {}), {}, device());
  };
  const Shape plain = extract(find_leaves(*shared_ash(), {}), {}, device());
  EXPECT_NEAR(volume(shape_with(1e4).mesh) / volume(plain.mesh), 1, 0.02);
  try {
    shape_with(1e9);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_NE(std::string(error.what()).find("apart, too far"), std::string::npos) << error.what();
  }
}

// Code that fills a LeafSet by hand may forget to set the crown.
TEST(Crown, MustBeSet) {
  LeafSet leaves = find_leaves(*shared_ash(), {});
  leaves.crown = {};
  EXPECT_THROW(extract(leaves, {}, device()), Error);
}

}  // namespace
}  // namespace leafhull
