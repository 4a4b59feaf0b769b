// SPDX-License-Identifier: Apache-2.0
// Whole pictures: direct ones agree with those of the mesh, and in motion paint stays in its place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "leafhull/render.h"
#include "picture/artist.h"
#include "property/extractions.h"

namespace leafhull {
namespace {

using render::Buffers;
using render::Object;
using test::device;

std::shared_ptr<const TreeModel> shared_tree(const std::filesystem::path& file) {
  return std::make_shared<const TreeModel>(read_tree(file));
}

Subject subject_of(const std::shared_ptr<const TreeModel>& tree, const Options& options,
                   Surfacing surfacing, const Frame& frame = {}) {
  return tree_subject(tree, find_leaves(*tree, options.leaf_options()), options, surfacing,
                      device(), {}, frame);
}

/// How well two pictures of one view agree.
struct Agreement {
  double overlap = 0;      ///< the silhouettes' intersection over their union
  double foliage = 0;      ///< the same for the foliage alone
  double median_turn = 0;  ///< median angle between the normals, degrees
  double far_apart = 0;  ///< share of pixels in one silhouette that are over a pixel from the other
};

Agreement agreement(const Buffers& a, const Buffers& b) {
  const auto covered = [](const Buffers& buffers, int x, int y) {
    return buffers.object[static_cast<std::size_t>(y) * buffers.width + x] != Object::paper;
  };
  std::size_t both = 0, either = 0, apart = 0, foliage_in_both = 0, foliage = 0;
  std::vector<double> turns;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * a.width + x;
      const bool in_a = covered(a, x, y), in_b = covered(b, x, y);
      both += in_a && in_b, either += in_a || in_b;
      const bool leaf_a = a.object[i] == Object::foliage, leaf_b = b.object[i] == Object::foliage;
      foliage += leaf_a || leaf_b;
      if (leaf_a && leaf_b) {
        ++foliage_in_both;
        const double cosine = std::clamp(dot(Vec3d(a.normal[i]), Vec3d(b.normal[i])), -1.0, 1.0);
        turns.push_back(std::acos(cosine) * 180 / M_PI);
      }
      if (in_a == in_b) continue;
      // The pixel counts unless a neighbour lies on the other silhouette.
      const Buffers& other = in_a ? b : a;
      bool near = false;
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, a.height - 1); ++j) {
        for (int k = std::max(x - 1, 0); k <= std::min(x + 1, a.width - 1); ++k) {
          near = near || covered(other, k, j);
        }
      }
      apart += !near;
    }
  }
  const auto middle = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2);
  std::nth_element(turns.begin(), middle, turns.end());
  return {static_cast<double>(both) / static_cast<double>(either),
          static_cast<double>(foliage_in_both) / static_cast<double>(foliage), *middle,
          static_cast<double>(apart) / static_cast<double>(either)};
}

void expect_direct_as_mesh(const std::filesystem::path& file, Style style) {
  SCOPED_TRACE(file.filename().string() + ", " + std::string(name(style)));
  const auto tree = shared_tree(file);
  Options options;
  options.style = style;
  // Styles with small radii need finer voxels before their mesh is as close to the density.
  options.preset = style == Style::painterly ? Preset::standard : Preset::fine;
  PictureOptions picture;
  picture.width = picture.height = 640;
  const Rendering direct = draw(subject_of(tree, options, Surfacing::direct), picture, device());
  const Rendering mesh = draw(subject_of(tree, options, Surfacing::mesh), picture, device());
  const Agreement found = agreement(*direct.buffers, *mesh.buffers);
  std::printf(
      "%-20s %-12s overlap %.4f, foliage alone %.4f, normals %.3f degrees apart, %.5f over a "
      "pixel\n",
      file.filename().c_str(), std::string(name(style)).c_str(), found.overlap, found.foliage,
      found.median_turn, found.far_apart);
  EXPECT_GE(found.overlap, 0.995);
  EXPECT_GE(found.foliage, 0.995);
  for (const Rendering* one : {&direct, &mesh}) {
    const Buffers& seen = *one->buffers;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (seen.object[i] == Object::paper) continue;
      ASSERT_NEAR(dot(seen.eye - seen.position[i], seen.to_eye), seen.depth[i], 1e-4f) << i;
    }
  }
  EXPECT_LT(found.median_turn, 3);
  EXPECT_LT(found.far_apart, 0.001);
}

class DirectPicture : public testing::TestWithParam<Style> {};

INSTANTIATE_TEST_SUITE_P(Styles, DirectPicture,
                         testing::Values(Style::painterly, Style::paper_thin, Style::paper_fat,
                                         Style::paper_previous),
                         [](const auto& test) {
                           std::string text(name(test.param));
                           std::replace(text.begin(), text.end(), '-', '_');
                           return text;
                         });

TEST_P(DirectPicture, AgreesWithTheMeshs) {
  expect_direct_as_mesh(std::filesystem::path(LEAFHULL_EXAMPLES) / "ash.glb", GetParam());
}

TEST_P(DirectPicture, AgreesWithTheMeshsOnRealTrees) {
  const std::filesystem::path folder(LEAFHULL_SHARED_TREES);
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared trees at " << folder;
  for (const char* file : {"birch.glb", "callistemon.glb"}) {
    expect_direct_as_mesh(folder / file, GetParam());
  }
}

/// The mean change of a channel from one picture to the other, of 255, where either has paint.
double change(const Rendering& a, const Rendering& b) {
  double sum = 0;
  std::size_t count = 0;
  const Buffers &p = *a.buffers, &q = *b.buffers;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.object[i] == Object::paper && q.object[i] == Object::paper) continue;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      sum += std::abs(a.picture.rgb[c] - b.picture.rgb[c]);
    }
    count += 3;
  }
  return sum / static_cast<double>(count);
}

/// The classic style with some keys replaced.
WatercolourStyle classic_with(const std::string& keys) {
  const auto file = std::filesystem::path(testing::TempDir()) / "leafhull-style.json";
  std::ofstream(file) << "{" << keys << "}";
  WatercolourStyle style(file.string());
  std::filesystem::remove(file);
  return style;
}

/// Keys that leave out the grain of pigment and paper, whatever the seed.
const char* const kNoGrain =
    R"("roughness": 0, "relief": 0, "warm_cool": 0, "turbulence": 0, "backruns": 0, "dispersion": 0,
       "wobble": 0, "detail": 0)";

PictureOptions watercolour(const WatercolourStyle& style, double degrees = 0) {
  PictureOptions options;
  options.look = Look::watercolour;
  options.width = options.height = 512;
  options.turntable = true;
  options.turn = degrees / 360;
  options.style = style;
  return options;
}

/// How much paint changes when the subject moves: with grain that stays in the subject's space,
/// with grain that differs in each frame, and without grain.
struct Motion {
  double coherent, swimming, without;
  /// What grain adds to the change, as a share of what it adds if it differs in each frame.
  double of_grain() const { return (coherent - without) / (swimming - without); }
};

Motion motion(const Subject& before, const Subject& after, double degrees) {
  const auto frame = [](const Subject& subject, const WatercolourStyle& style, double turn) {
    return draw(subject, watercolour(style, turn), device());
  };
  const WatercolourStyle style = classic_with(R"("detail": 0)");
  const WatercolourStyle other = classic_with(R"("detail": 0, "seed": 2)");
  const WatercolourStyle smooth = classic_with(kNoGrain);
  const Rendering first = frame(before, style, 0);
  const Motion found{change(first, frame(after, style, degrees)),
                     change(first, frame(after, other, degrees)),
                     change(frame(before, smooth, 0), frame(after, smooth, degrees))};
  std::printf("mean change: %.2f of 255 with grain, %.2f with grain that swims, %.2f without\n",
              found.coherent, found.swimming, found.without);
  return found;
}

TEST(WatercolourInMotion, GrainStaysOverATurn) {
  const Subject ash = subject_of(shared_tree(std::filesystem::path(LEAFHULL_EXAMPLES) / "ash.glb"),
                                 {}, Surfacing::direct);
  EXPECT_LT(motion(ash, ash, 1).of_grain(), 0.25);
  // Grain that stays adds little, less the smaller the motion; grain that swims always adds much.
  EXPECT_LT(motion(ash, ash, 0.1).of_grain(), 0.05);
}

TEST(WatercolourInMotion, GrainStaysInASwayingTree) {
  const auto still = shared_tree(std::filesystem::path(LEAFHULL_EXAMPLES) / "ash.glb");
  const Frame frame = frame_of(find_leaves(*still, {}), 0);
  const Subject before = subject_of(still, {}, Surfacing::direct, frame);
  const auto leaning = [&](double slope) {
    TreeModel tree = *still;
    for (Instance& instance : tree.instances) {
      for (int i = 0; i < 4; ++i) instance.to_world[0][i] += slope * instance.to_world[1][i];
    }
    return subject_of(std::make_shared<const TreeModel>(tree), {}, Surfacing::direct, frame);
  };
  // A breeze moves the top of the crown by three pixels, and by a third of one.
  EXPECT_LT(motion(before, leaning(0.006), 0).of_grain(), 0.25);
  EXPECT_LT(motion(before, leaning(0.0006), 0).of_grain(), 0.05);
}

}  // namespace
}  // namespace leafhull
