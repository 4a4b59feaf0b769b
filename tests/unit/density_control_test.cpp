// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "density/control.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

/// A point for a leaf vertex or, with an area, for leaf area.
LeafPoint leaf(float major, float minor, double area = 0) {
  return {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, major, minor, area};
}

const Box kCrown{{-1, -1, -1}, {1, 1, 1}};

/// Options for leaf vertices, with the paper's band.
ControlOptions at_vertices() {
  return {.low = {0, {}}, .high = {2, {}}, .points = PointSource::vertices};
}

ControlOptions controlled(double flatness) {
  return {.method = Method::controlled, .flatness = flatness, .points = PointSource::vertices};
}

TEST(Control, StatisticsOfEquations9And10) {
  const std::vector<LeafPoint> leaves(4, leaf(1, 1));
  const std::vector<float> density{1, 2, 3, 6};
  ControlOptions options = at_vertices();
  const DensityStatistics s = density_statistics(leaves, density, kCrown, options);
  EXPECT_DOUBLE_EQ(s.mean, 3);
  EXPECT_DOUBLE_EQ(s.variance, 3.5);
  EXPECT_DOUBLE_EQ(s.p1, 3);
  EXPECT_DOUBLE_EQ(s.p2, 3 + 2 * std::sqrt(3.5));

  options.spread = Spread::variance;
  options.low = {-1, {}};
  const DensityStatistics v = density_statistics(leaves, density, kCrown, options);
  EXPECT_DOUBLE_EQ(v.p1, 3 - 3.5);
  EXPECT_DOUBLE_EQ(v.p2, 3 + 2 * 3.5);
}

TEST(Control, AnisotropyRisesFromP1ToP2) {
  const DensityStatistics s{.mean = 0, .variance = 0, .p1 = 2, .p2 = 4};
  EXPECT_EQ(anisotropy(1.5, s), 0);
  EXPECT_EQ(anisotropy(2, s), 0);
  EXPECT_EQ(anisotropy(2.5, s), 0.25);
  EXPECT_EQ(anisotropy(4, s), 1);
  EXPECT_EQ(anisotropy(9, s), 1);
}

TEST(Control, WhereP1IsP2MoreIsDense) {
  const DensityStatistics s{.mean = 3, .variance = 0, .p1 = 3, .p2 = 3};
  EXPECT_EQ(anisotropy(3, s), 0);
  EXPECT_EQ(anisotropy(std::nextafter(3.0, 4.0), s), 1);
}

TEST(Control, RadiiOfEquations7And8) {
  const DensityStatistics s{.mean = 0, .variance = 0, .p1 = 2, .p2 = 4};
  const std::vector<LeafPoint> leaves(3, leaf(1.0f, 0.5f));
  const std::vector<float> density{2, 3, 4};
  const auto k = controlled_kernels(leaves, density, s, 2.0, controlled(0.8));
  ASSERT_EQ(k.size(), 3u);
  EXPECT_FLOAT_EQ(k[0].radius_major, 2);
  EXPECT_FLOAT_EQ(k[0].radius_normal, 2);
  EXPECT_FLOAT_EQ(k[1].radius_major, 1.5f);   // halfway from 2 to 1
  EXPECT_FLOAT_EQ(k[1].radius_minor, 1.25f);  // to 0.5
  EXPECT_FLOAT_EQ(k[1].radius_normal, 1.2f);  // to 0.8 * 0.5
  EXPECT_FLOAT_EQ(k[2].radius_major, 1);
  EXPECT_FLOAT_EQ(k[2].radius_minor, 0.5f);
  EXPECT_FLOAT_EQ(k[2].radius_normal, 0.4f);
}

TEST(Control, MethodsDifferInTheirRadiiAlone) {
  const DensityStatistics s{.mean = 0, .variance = 0, .p1 = 2, .p2 = 4};
  const std::vector<LeafPoint> leaves(1, leaf(1.0f, 0.5f));
  const std::vector<float> density{2};
  ControlOptions options = controlled(1.0);
  options.method = Method::uncontrolled;
  EXPECT_FLOAT_EQ(controlled_kernels(leaves, density, s, 2.0, options)[0].radius_minor, 0.5f);
  options.method = Method::isotropic;
  EXPECT_FLOAT_EQ(controlled_kernels(leaves, density, s, 2.0, options)[0].radius_minor, 2);
}

TEST(Control, RadiusHasAFloor) {
  const DensityStatistics s{.mean = 0, .variance = 0, .p1 = 2, .p2 = 4};
  const std::vector<LeafPoint> leaves(1, leaf(1.0f, 1e-9f));
  const auto k = controlled_kernels(leaves, std::vector<float>{5}, s, 2.0, controlled(0.5));
  EXPECT_FLOAT_EQ(k[0].radius_minor, 2e-3f);
  EXPECT_FLOAT_EQ(k[0].radius_normal, 2e-3f);
}

TEST(Control, NoRadiusExceedsTheLargest) {
  const DensityStatistics s{.mean = 0, .variance = 0, .p1 = 2, .p2 = 4};
  const std::vector<LeafPoint> leaves(1, leaf(9.0f, 5.0f));
  for (const float density : {1.0f, 3.0f, 5.0f}) {
    const auto k = controlled_kernels(leaves, std::vector<float>{density}, s, 2.0, controlled(0.8));
    EXPECT_FLOAT_EQ(k[0].radius_major, 2);
    EXPECT_FLOAT_EQ(k[0].radius_minor, 2);
    EXPECT_FLOAT_EQ(k[0].radius_normal, 2);
  }
}

TEST(Control, KernelsOfLeafAreaIntegrateToItOverTheirPlane) {
  const DensityStatistics s{.mean = 0, .variance = 0, .p1 = 2, .p2 = 4};
  const std::vector<LeafPoint> leaves{leaf(1.0f, 0.5f, 0.7)};
  for (const int falloff : {1, 2, 3}) {
    ControlOptions options = controlled(0.8);
    options.falloff = falloff;
    for (const Kernel& k : {controlled_kernels(leaves, std::vector<float>{4}, s, 2.0, options)[0],
                            isotropic_kernels(leaves, 2.0, falloff)[0]}) {
      const double integral =
          k.weight * std::numbers::pi * k.radius_major * k.radius_minor / (falloff + 1);
      EXPECT_NEAR(integral, 0.7, 1e-6);
    }
  }
  EXPECT_EQ(isotropic_kernels(std::vector{leaf(1, 1)}, 2.0, 2)[0].weight, 1) << "at a vertex";
}

TEST(Control, LeafPointsCountByTheirArea) {
  const std::vector<LeafPoint> leaves{leaf(1, 1, 3), leaf(1, 1, 1)};
  ControlOptions options = at_vertices();
  options.points = PointSource::area;
  const DensityStatistics s = density_statistics(leaves, std::vector<float>{1, 5}, kCrown, options);
  EXPECT_DOUBLE_EQ(s.mean, 2);
  EXPECT_DOUBLE_EQ(s.variance, 3);
  // A ripple does not count as spread.
  const DensityStatistics even =
      density_statistics(leaves, std::vector<float>{1.01f, 0.97f}, kCrown, options);
  EXPECT_NEAR(even.p2, 1.3 * even.mean, 1e-9);
}

TEST(Control, TheBandByShares) {
  const std::vector<LeafPoint> leaves(10, leaf(1, 1));
  const std::vector<float> density{7, 1, 9, 3, 5, 10, 2, 8, 4, 6};
  const auto band_of = [&](double low, double high) {
    ControlOptions options = at_vertices();
    options.low = {{}, low};
    options.high = {{}, high};
    return density_statistics(leaves, density, kCrown, options);
  };
  EXPECT_EQ(band_of(30, 70).p1, 3);
  EXPECT_EQ(band_of(30, 70).p2, 7);
  EXPECT_EQ(band_of(0, 100).p1, 1);
  EXPECT_EQ(band_of(0, 100).p2, 10);
  EXPECT_EQ(band_of(31, 31).p1, 4);
  EXPECT_EQ(band_of(31, 31).p2, 4);
}

TEST(Control, TheBandByShareOfAreaIsNoNarrowerThanARipple) {
  const std::vector<LeafPoint> leaves{leaf(1, 1, 1), leaf(1, 1, 2), leaf(1, 1, 1)};
  ControlOptions options = at_vertices();
  options.points = PointSource::area;
  options.low = {{}, 30};
  options.high = {{}, 75};
  const DensityStatistics s =
      density_statistics(leaves, std::vector<float>{1, 2, 4}, kCrown, options);
  EXPECT_DOUBLE_EQ(s.mean, 2.25);
  EXPECT_DOUBLE_EQ(s.p1, 2 - 0.15 * s.mean) << "both shares end at one density, 2";
  EXPECT_DOUBLE_EQ(s.p2, 2 + 0.15 * s.mean);
}

TEST(Control, ABandUpsideDownOnThisTree) {
  const std::vector<LeafPoint> leaves(3, leaf(1, 1));
  ControlOptions options = at_vertices();
  options.low = {0, {}};
  options.high = {{}, 10};
  try {
    (void)density_statistics(leaves, std::vector<float>{1, 2, 3}, kCrown, options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(std::string(error.what()).find("--band-high 10%"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("--band-low 0"), std::string::npos) << error.what();
  }
}

TEST(Control, StraysCountForNothing) {
  std::vector<LeafPoint> leaves(3, leaf(1, 1));
  leaves[1].position = {0, 5, 0};
  const DensityStatistics s =
      density_statistics(leaves, std::vector<float>{1, 100, 3}, kCrown, at_vertices());
  EXPECT_DOUBLE_EQ(s.mean, 2);
  EXPECT_DOUBLE_EQ(s.variance, 1);
}

TEST(Control, CoverageKeepsClearOfSheets) {
  std::vector<WeightedDensity> closed;  // one sheet: N = 1 except for a ripple
  for (int i = 0; i < 100; ++i) closed.push_back({0.98f + 0.0004f * static_cast<float>(i)});
  EXPECT_NEAR(clear_of_sheets(closed, 0.985, 0.92), 0.6, 0.01);
  std::vector<WeightedDensity> wide;
  for (int i = 0; i < 100; ++i) wide.push_back({0.05f * static_cast<float>(i)});
  EXPECT_EQ(clear_of_sheets(wide, 0.4, 0.92), 0.4);
  EXPECT_EQ(clear_of_sheets(wide, 2.5, 0.5), 2.5);
  EXPECT_EQ(clear_of_sheets(wide, 0.9, 0.98), 0.6) << "a lone sheet is inside";
}

TEST(Control, CoverageIsTheShareAtOrAboveT) {
  const std::vector<float> density{4, 1, 3, 2, 5};
  for (const double coverage : {0.2, 0.4, 0.6, 0.8, 1.0}) {
    const double t = threshold_for_coverage(density, coverage);
    const auto covered =
        std::count_if(density.begin(), density.end(), [&](float n) { return n >= t; });
    EXPECT_EQ(static_cast<double>(covered), 5 * coverage);
  }
  EXPECT_DOUBLE_EQ(threshold_for_coverage(density, 0.6), 2.5);
}

}  // namespace
}  // namespace leafhull
