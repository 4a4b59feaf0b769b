// SPDX-License-Identifier: Apache-2.0
// Every pass on a few pixels with a known result, on both variants of the kernels.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "leafhull/device.h"
#include "watercolour/passes.h"

namespace leafhull::watercolour {
namespace {

using Values = std::vector<float>;
constexpr float kNear = 1e-5f;

float smooth(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

class PassesTest : public testing::TestWithParam<const char*> {
 protected:
  Device& device() {
    static Device vector({.choice = "", .threads = 0, .variant = "vector"});
    static Device work_item({.choice = "", .threads = 0, .variant = "work-item"});
    return GetParam() == std::string("vector") ? vector : work_item;
  }
};

INSTANTIATE_TEST_SUITE_P(Variants, PassesTest, testing::Values("vector", "work-item"),
                         [](const auto& test) {
                           return test.param == std::string("vector") ? "Vector" : "WorkItem";
                         });

TEST_P(PassesTest, PlanesComeBackAsTheyWent) {
  for (const auto [width, height] : {std::array{1, 1}, {7, 3}, {16, 16}, {33, 50}}) {
    Passes passes(device(), width, height);
    Values values(static_cast<std::size_t>(width) * height);
    std::iota(values.begin(), values.end(), 1.0f);
    EXPECT_EQ(passes.download(passes.upload(values)), values);
    EXPECT_EQ(passes.download(passes.constant(3)), Values(values.size(), 3));
  }
}

TEST_P(PassesTest, ABlurKeepsConstants) {
  for (const auto [width, height] : {std::array{1, 1}, {7, 3}, {40, 23}}) {
    Passes passes(device(), width, height);
    const Values values(static_cast<std::size_t>(width) * height, 0.7f);
    for (const float sigma : {0.0f, 0.6f, 3.0f, 20.0f}) {
      for (const float v : passes.download(passes.blur(passes.upload(values), sigma))) {
        EXPECT_NEAR(v, 0.7f, kNear) << width << " " << sigma;
      }
    }
  }
}

TEST_P(PassesTest, ABlurOfAnImpulseIsAGaussian) {
  constexpr int kWidth = 41, kHeight = 37, kX = 20, kY = 18;
  constexpr double kSigma = 3;
  Passes passes(device(), kWidth, kHeight);
  Values values(kWidth * kHeight);
  values[kY * kWidth + kX] = 1;
  const Values blurred = passes.download(passes.blur(passes.upload(values), kSigma));
  for (int y = kY - 6; y <= kY + 6; ++y) {
    for (int x = kX - 6; x <= kX + 6; ++x) {
      const double d2 = (x - kX) * (x - kX) + (y - kY) * (y - kY);
      const double gaussian = std::exp(-d2 / (2 * kSigma * kSigma)) / (2 * M_PI * kSigma * kSigma);
      EXPECT_NEAR(blurred[y * kWidth + x], gaussian, 0.03 * gaussian) << x << " " << y;
    }
  }
  EXPECT_NEAR(std::accumulate(blurred.begin(), blurred.end(), 0.0), 1, 1e-4);
}

TEST_P(PassesTest, ABlurIsTheSameTurned) {
  Passes wide(device(), 19, 5), tall(device(), 5, 19);
  Values values(95), turned(95);
  for (int i = 0; i < 95; ++i) values[i] = static_cast<float>(i * i % 37);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 19; ++x) turned[x * 5 + y] = values[y * 19 + x];
  }
  const Values a = wide.download(wide.blur(wide.upload(values), 2));
  const Values b = tall.download(tall.blur(tall.upload(turned), 2));
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 19; ++x) EXPECT_NEAR(a[y * 19 + x], b[x * 5 + y], 1e-4f);
  }
}

TEST_P(PassesTest, ThePaperIsSeamless) {
  constexpr int kSize = 64;
  Passes passes(device(), 2 * kSize, 2 * kSize);
  const PaperPlanes paper = passes.paper(kSize, 9, 5);
  for (const Plane& plane : {paper.height, paper.speckle, paper.sway, paper.relief}) {
    const Values v = passes.download(plane);
    const auto at = [&](int x, int y) { return v[y * 2 * kSize + x]; };
    double change = 0, seam = 0;
    for (int i = 0; i < kSize; ++i) {
      for (int j = 0; j < kSize; ++j) {
        EXPECT_NEAR(at(i, j), at(i + kSize, j), 2e-3f);
        EXPECT_NEAR(at(i, j), at(i, j + kSize), 2e-3f);
      }
      change += std::abs(at(31, i) - at(30, i)) + std::abs(at(i, 31) - at(i, 30));
      seam += std::abs(at(kSize, i) - at(kSize - 1, i)) + std::abs(at(i, kSize) - at(i, kSize - 1));
    }
    EXPECT_GT(change, 0);
    EXPECT_LT(seam, 2 * change);  // there is no step at the edge
  }
}

TEST_P(PassesTest, ThePaperIsItsSeeds) {
  Passes passes(device(), 50, 50);
  const auto height = [&](std::uint32_t seed) {
    return passes.download(passes.paper(50, 8, seed).height);
  };
  const Values paper = height(1);
  EXPECT_EQ(paper, height(1));
  EXPECT_NE(paper, height(2));
  const auto [low, high] = std::minmax_element(paper.begin(), paper.end());
  EXPECT_GE(*low, 0);
  EXPECT_LE(*high, 1);
  EXPECT_GT(*high - *low, 0.3f);
  EXPECT_NEAR(std::accumulate(paper.begin(), paper.end(), 0.0) / 2500, 0.5, 0.06);
}

TEST_P(PassesTest, TheGroundIsDensestAtItsMiddle) {
  Passes passes(device(), 81, 41);
  const Values ground = passes.download(passes.ground(41, {40.5f, 20.5f}, {30, 10}, 1));
  EXPECT_GT(ground[20 * 81 + 40], 0.5f);
  EXPECT_LT(ground[0], 0);
  EXPECT_LT(ground[40 * 81 + 80], 0);
}

/// Two pixels: foliage and paper.
render::Buffers two_pixels() {
  render::Buffers b;
  b.resize(2, 1);
  b.object[0] = render::Object::foliage;
  b.normal[0] = {0, 0.6f, 0.8f};
  b.position[0] = {1, 2, 3};
  b.depth[0] = 5;
  b.key[0] = 0.5f, b.open[0] = 0.25f;
  b.to_light = {0, 0, 1};
  return b;
}

TEST_P(PassesTest, SeesLightAndPlaces) {
  Passes passes(device(), 2, 1);
  const SeenPlanes seen = passes.see(two_pixels(), 0.4f, 0.25f);
  const float direct = 0.5f * (0.8f + 0.25f) / 1.25f;
  EXPECT_EQ(passes.download(seen.seen), (Values{1, 0}));
  EXPECT_NEAR(passes.download(seen.light)[0], 0.6f * direct + 0.4f * 0.25f, kNear);
  EXPECT_EQ(passes.download(seen.light)[1], 0);
  EXPECT_EQ(passes.download(seen.far), (Values{5, 0}));
  EXPECT_EQ(passes.download(seen.x), (Values{1, 0}));
  EXPECT_EQ(passes.download(seen.y), (Values{2, 0}));
  EXPECT_EQ(passes.download(seen.z), (Values{3, 0}));
}

TEST_P(PassesTest, DarknessIsWhatIsMissingOfTheLight) {
  Passes passes(device(), 3, 1);
  const Plane dark =
      passes.darkness(passes.upload(Values{0.3f, 0.15f, 0}), passes.upload(Values{1, 0.5f, 0}));
  const Values v = passes.download(dark);
  EXPECT_NEAR(v[0], 0.7f, kNear);
  EXPECT_NEAR(v[1], 0.7f, kNear);  // half a pixel is as dark as a whole pixel
  EXPECT_NEAR(v[2], 1, kNear);
}

TEST_P(PassesTest, NoiseStaysWithItsPoint) {
  Passes passes(device(), 40, 1);  // three vectors, the last one without a subject
  Values near(40), x(40), y(40), z(40);
  const auto put = [&](int i, Vec3f p) { near[i] = 1, x[i] = p.x, y[i] = p.y, z[i] = p.z; };
  put(0, {0.3f, 0.1f, -0.2f}), put(17, {0.3f, 0.1f, -0.2f}), put(2, {-0.7f, 1.4f, 0.9f});
  const std::array<Plane, 3> places{passes.upload(x), passes.upload(y), passes.upload(z)};
  const FlowPlanes a = passes.flow(passes.upload(near), places, 7, 45, 1);
  const FlowPlanes b = passes.flow(passes.upload(near), places, 7, 45, 2);
  for (const auto member : {&FlowPlanes::turbulence, &FlowPlanes::warmth, &FlowPlanes::breaking,
                            &FlowPlanes::wetness}) {
    const Values v = passes.download(a.*member);
    EXPECT_EQ(v[0], v[17]);
    EXPECT_NE(v[0], v[2]);
    EXPECT_NE(v[0], 0);
    EXPECT_LT(std::abs(v[0]), 1.5f);
    EXPECT_EQ(v[39], 0);
    EXPECT_NE(v, passes.download(b.*member));
  }
}

TEST_P(PassesTest, WhatIsSeenGoesOnBeyondTheSilhouette) {
  Passes passes(device(), 3, 1);
  const Plane value =
      passes.extend(passes.upload(Values{1, 0, 0}), passes.upload(Values{5, 0, 0}),
                    passes.upload(Values{0.5f, 0.25f, 0}), passes.upload(Values{2, 1, 0}));
  EXPECT_EQ(passes.download(value), (Values{5, 4, 0}));
}

TEST_P(PassesTest, VisibilityIsTheBlurredDepthTest) {
  Passes passes(device(), 4, 1);
  const Plane visible = passes.visibility(passes.upload(Values{1, 2.5f, 2.25f, 4}),
                                          passes.constant(0.25f), passes.constant(0.25f * 2), 0.5f);
  const Values v = passes.download(visible);
  EXPECT_NEAR(v[0], 1, kNear);     // in front of its neighbourhood
  EXPECT_NEAR(v[1], 0, kNear);     // half a unit behind it
  EXPECT_NEAR(v[2], 0.5f, kNear);  // halfway
  EXPECT_NEAR(v[3], 0, kNear);
}

TEST_P(PassesTest, AMaskHidesByItsAmount) {
  Passes passes(device(), 3, 1);
  const Plane a = passes.constant(0.8f), by = passes.upload(Values{0, 0.5f, 1});
  EXPECT_EQ(passes.download(passes.mask(a, by, 0)), (Values{0.8f, 0.8f, 0.8f}));
  EXPECT_NEAR(passes.download(passes.mask(a, by, 1))[0], 0, kNear);
  EXPECT_NEAR(passes.download(passes.mask(a, by, 0.5f))[1], 0.6f, kNear);
}

class LayerTest : public PassesTest {
 protected:
  Passes passes{device(), 5, 1};
  PaperPlanes paper{passes.constant(0.5f), {}, passes.constant(0), {}};
  FlowPlanes flow{{}, {}, passes.constant(0), passes.constant(0)};
  Plane rho = passes.upload(Values{0, 0.4f, 0.5f, 0.6f, 1});

  Values layer(const Edge& edge, float within = 1) {
    return passes.download(passes.layer(rho, passes.constant(within), paper, flow, edge));
  }
  void expect(const Values& values, const Values& expected) {
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-4f) << i;
  }
};

INSTANTIATE_TEST_SUITE_P(Variants, LayerTest, testing::Values("vector", "work-item"),
                         [](const auto& test) {
                           return test.param == std::string("vector") ? "Vector" : "WorkItem";
                         });

TEST_P(LayerTest, IsASmoothstepAroundItsLevel) {
  expect(layer({.level = 0.5f, .softness = 0.1f}), {0, 0, 0.5f, 1, 1});
  const float low = smooth(0, 1, 0.4f);
  expect(layer({.level = 0.5f, .softness = 0.5f}), {0, low, 0.5f, 1 - low, 1});
  expect(layer({.level = 0.5f, .softness = 0.1f}, 0.5f), {0, 0, 0.25f, 0.5f, 0.5f});
}

TEST_P(LayerTest, LeavesPaperWhereThereIsNothingHoweverSoftItIs) {
  const Values values = layer({.level = 0.4f, .softness = 0.6f});
  EXPECT_EQ(values[0], 0);
  EXPECT_GT(values[1], 0);
}

TEST_P(LayerTest, ThePaperAndLeavesMoveItsEdge) {
  paper.height = passes.constant(0.75f), paper.sway = passes.constant(-1);
  flow.breaking = passes.constant(0.5f);
  const Values raised{0, 0.5f, 1, 1, 1}, lowered{0, 0, 0, 0.5f, 1};
  expect(layer({.level = 0.5f, .softness = 0.1f, .dryness = 0.4f}), raised);
  expect(layer({.level = 0.5f, .softness = 0.1f, .wobble = 0.1f}), lowered);
  expect(layer({.level = 0.5f, .softness = 0.1f, .raggedness = 0.2f}), raised);
}

TEST_P(LayerTest, NothingMovesPaintToWhereThereIsNone) {
  paper.height = passes.constant(1);
  EXPECT_NEAR(layer({.level = 0.5f, .softness = 0.1f, .dryness = 2})[0], 0, kNear);
}

TEST_P(LayerTest, EdgesAreLostInWetPatches) {
  flow.wetness = passes.constant(1);
  const float low = smooth(0, 1, 0.4f);
  expect(layer({.level = 0.5f, .softness = 0.1f, .lost = 0.4f}), {0, low, 0.5f, 1 - low, 1});
}

TEST_P(PassesTest, EdgesAreDarkerThanWhatLiesInside) {
  Passes passes(device(), 3, 1);
  const Values v = passes.download(passes.darken_edges(passes.upload(Values{0, 1, 0.8f}),
                                                       passes.upload(Values{0.5f, 0.5f, 0.8f}), 2));
  EXPECT_NEAR(v[0], 0, kNear);  // no pigment outside
  EXPECT_NEAR(v[1], 2, kNear);  // 1 (1 + 2 (1 - 0.5))
  EXPECT_NEAR(v[2], 0.8f, kNear);
}

TEST_P(PassesTest, DilutionThinsTheLights) {
  Passes passes(device(), 3, 1);
  const Plane dark = passes.upload(Values{0, 1, 1 - 0.575f});
  const auto diluted = [&](float t, float turbulent, float backruns, float dilution) {
    const Plane density = passes.constant(2);
    passes.dilute(density, passes.constant(t), dark, turbulent, backruns, dilution);
    return passes.download(density);
  };
  const Values lights = diluted(0, 0, 0, 0.5f);
  EXPECT_NEAR(lights[0], 1, kNear);
  EXPECT_NEAR(lights[1], 2, kNear);
  EXPECT_NEAR(lights[2], 1.5f, 1e-4f);
  EXPECT_NEAR(diluted(0.5f, 0.5f, 0, 0)[0], 2.5f, kNear);
  EXPECT_NEAR(diluted(-0.5f, 0.5f, 0, 0)[0], 1.5f, kNear);
  EXPECT_NEAR(diluted(-0.1f, 0, 1, 0)[0], 2, kNear);  // ahead of the front of a backrun
  EXPECT_NEAR(diluted(0.03f, 0, 1, 0)[0], 4, kNear);  // on the front
  EXPECT_NEAR(diluted(0.3f, 0, 1, 0)[0], 2, kNear);   // far behind it
}

TEST_P(PassesTest, PigmentSettlesInValleys) {
  Passes passes(device(), 3, 1);
  PaperPlanes paper;
  paper.height = passes.upload(Values{0, 0.5f, 1});
  paper.speckle = passes.constant(0);
  const Plane density = passes.constant(0.5f);
  passes.granulate(density, paper, 0.4f, 0);
  const Values v = passes.download(density);
  EXPECT_NEAR(v[0], 0.5f * (1 + 0.5f * 0.4f * 0.65f), kNear);
  EXPECT_NEAR(v[1], 0.5f * (1 + 0.5f * 0.4f * 0.15f), kNear);
  EXPECT_NEAR(v[2], 0.5f * (1 - 0.5f * 0.4f * 0.35f), kNear);
  paper.speckle = passes.constant(1);
  const Plane specked = passes.constant(0.5f);
  passes.granulate(specked, paper, 0, 0.2f);
  EXPECT_NEAR(passes.download(specked)[1], 0.5f * (1 + 0.5f * 0.2f), kNear);
}

TEST_P(PassesTest, ACoatOfPigmentIsItsColour) {
  Passes passes(device(), 3, 1);
  const auto minus_log = [](float c) { return -std::log(c); };
  const Vec3f color{0.8f, 0.6f, 0.4f};
  const Vec3f absorbance{minus_log(0.8f), minus_log(0.6f), minus_log(0.4f)};
  const std::array<Plane, 3> sum{passes.constant(0), passes.constant(0), passes.constant(0)};
  const Plane relief = passes.constant(1), level = passes.constant(0);
  passes.glaze(passes.upload(Values{0, 1, 2}), level, {absorbance, absorbance}, 1, sum);
  const std::vector<std::uint8_t> rgb = passes.develop(sum, relief, {1, 0.9f, 1}, 0);
  const auto byte = [](float c) { return static_cast<int>(std::lround(255 * c)); };
  EXPECT_EQ(rgb[0], 255);
  EXPECT_EQ(rgb[1], byte(0.9f));
  EXPECT_EQ(rgb[3], byte(color.x));
  EXPECT_EQ(rgb[4], byte(0.9f * color.y));
  EXPECT_EQ(rgb[5], byte(color.z));
  EXPECT_EQ(rgb[6], byte(color.x * color.x));  // two coats: C^(1 + 1)
  EXPECT_EQ(rgb[8], byte(color.z * color.z));
}

TEST_P(PassesTest, PigmentsLeanToWarmAndCool) {
  Passes passes(device(), 3, 1);
  const std::array<Plane, 3> sum{passes.constant(0), passes.constant(0), passes.constant(0)};
  passes.glaze(passes.constant(1), passes.upload(Values{-1, 0, 1}), {{1, 0, 0}, {0, 0, 1}}, 0.5f,
               sum);
  const Values red = passes.download(sum[0]), blue = passes.download(sum[2]);
  EXPECT_NEAR(red[0], 1, kNear);
  EXPECT_NEAR(red[1], 0.5f, kNear);
  EXPECT_NEAR(red[2], 0, kNear);
  EXPECT_NEAR(blue[2], 1, kNear);
}

TEST_P(PassesTest, PaperIsShadedByItsRelief) {
  Passes passes(device(), 2, 1);
  const Plane none = passes.constant(0), relief = passes.upload(Values{0, 2});
  const std::array<Plane, 3> sum{none, none, none};
  const std::vector<std::uint8_t> rgb = passes.develop(sum, relief, {0.8f, 0.8f, 0.8f}, 0.1f);
  EXPECT_EQ(rgb[0], std::lround(255 * 0.8f * 0.9f));
  EXPECT_EQ(rgb[3], std::lround(255 * 0.8f * 1.1f));
}

TEST_P(PassesTest, ColoursBleedWhereItIsWet) {
  Passes passes(device(), 3, 1);
  const Plane wet = passes.wet(passes.upload(Values{-1, 1, 1}), passes.upload(Values{1, 1, 0}), 1);
  EXPECT_EQ(passes.download(wet), (Values{0, 1, 0}));
  const Plane absorbance = passes.constant(2);
  passes.bleed(absorbance, passes.constant(1), passes.upload(Values{0, 0.5f, 1}));
  EXPECT_EQ(passes.download(absorbance), (Values{2, 1.5f, 1}));
}

TEST_P(PassesTest, LeavesNoTraceOfPlanesUsedAgain) {
  Passes passes(device(), 5, 5);
  { const Plane old = passes.constant(9); }
  const Values values(25, 0.25f);
  EXPECT_EQ(passes.download(passes.upload(values)), values);
  { const Plane old = passes.constant(9); }
  EXPECT_NEAR(passes.download(passes.blur(passes.upload(values), 3))[12], 0.25f, kNear);
}

}  // namespace
}  // namespace leafhull::watercolour
