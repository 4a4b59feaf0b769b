// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <vector>

#include "render/light.h"
#include "watercolour/tones.h"

namespace leafhull::watercolour {
namespace {

constexpr Vec3f kGreen{0.1f, 0.3f, 0.05f}, kRed{0.5f, 0.04f, 0.02f}, kGold{0.6f, 0.4f, 0.03f};

render::Buffers pixels(const std::vector<Vec3f>& leaves) {
  render::Buffers buffers;
  buffers.resize(static_cast<int>(leaves.size()) + 1, 1);  // the last pixel is paper
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    buffers.object[i] = render::Object::foliage;
    buffers.color[i] = render::foliage_colour(leaves[i]);
  }
  return buffers;
}

TEST(Tones, AreWhereTheColourIs) {
  const std::vector<Vec3f> tones{kGreen, kRed, kGold};
  const Weights weights = weigh_tones(pixels({kGreen, kRed, kGold, kRed * 0.8f}), tones);
  ASSERT_EQ(weights.other.size(), 2u);
  EXPECT_EQ(weights.seen, (std::vector<float>{1, 1, 1, 1, 0}));
  EXPECT_LT(weights.others[0], 0.02f);
  EXPECT_GT(weights.other[0][1], 0.98f);
  EXPECT_GT(weights.other[1][2], 0.98f);
  EXPECT_GT(weights.other[0][3], 0.9f) << "a darker red is red";
  EXPECT_EQ(weights.others[4], 0);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(weights.others[i], weights.other[0][i] + weights.other[1][i], 1e-6f);
    EXPECT_LE(weights.others[i], weights.seen[i]);
  }
}

TEST(Tones, BetweenTwoIsSomeOfBoth) {
  const std::vector<Vec3f> tones{kGreen, kRed};
  const Weights weights = weigh_tones(pixels({(kGreen + kRed) * 0.5f}), tones);
  EXPECT_GT(weights.others[0], 0.05f);
  EXPECT_LT(weights.others[0], 0.95f);
}

}  // namespace
}  // namespace leafhull::watercolour
