// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "density/control.h"

namespace leafhull {
namespace {

LeafVertex leaf(float major, float minor) {
  return {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, major, minor, 0};
}

Options controlled(double flatness) {
  Options options;
  options.method = Method::controlled;
  options.flatness = flatness;
  return options;
}

TEST(Control, StatisticsOfEquations9And10) {
  const std::vector<float> density{1, 2, 3, 6};
  Options options;
  const DensityStatistics s = density_statistics(density, options);
  EXPECT_DOUBLE_EQ(s.mean, 3);
  EXPECT_DOUBLE_EQ(s.variance, 3.5);
  EXPECT_DOUBLE_EQ(s.p1, 3);
  EXPECT_DOUBLE_EQ(s.p2, 3 + 2 * std::sqrt(3.5));

  options.spread = Spread::variance;
  options.band_low = -1;
  const DensityStatistics v = density_statistics(density, options);
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
  const std::vector<LeafVertex> leaves(3, leaf(1.0f, 0.5f));
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
  const std::vector<LeafVertex> leaves(1, leaf(1.0f, 0.5f));
  const std::vector<float> density{2};
  Options options = controlled(1.0);
  options.method = Method::uncontrolled;
  EXPECT_FLOAT_EQ(controlled_kernels(leaves, density, s, 2.0, options)[0].radius_minor, 0.5f);
  options.method = Method::isotropic;
  EXPECT_FLOAT_EQ(controlled_kernels(leaves, density, s, 2.0, options)[0].radius_minor, 2);
}

TEST(Control, RadiusHasAFloor) {
  const DensityStatistics s{.mean = 0, .variance = 0, .p1 = 2, .p2 = 4};
  const std::vector<LeafVertex> leaves(1, leaf(1.0f, 1e-9f));
  const auto k = controlled_kernels(leaves, std::vector<float>{5}, s, 2.0, controlled(0.5));
  EXPECT_FLOAT_EQ(k[0].radius_minor, 2e-3f);
  EXPECT_FLOAT_EQ(k[0].radius_normal, 2e-3f);
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
