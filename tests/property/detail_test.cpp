// SPDX-License-Identifier: Apache-2.0
// A shape that nobody wants a report of is the same shape.
#include <gtest/gtest.h>

#include <string>

#include "leafhull/error.h"
#include "property/extractions.h"

namespace leafhull {
namespace {

using test::ash;
using test::device;

Shape alone(const Options& options) { return extract(ash(), options, device(), {}, Detail::shape); }

bool has_stage(const Shape& shape, std::string_view stage) {
  return std::ranges::find(shape.report.seconds, stage, &StageTime::stage) !=
         shape.report.seconds.end();
}

TEST(Detail, DoesNotChangeTheShape) {
  for (const Method method : {Method::isotropic, Method::uncontrolled, Method::controlled}) {
    for (const PointSource points : {PointSource::area, PointSource::vertices}) {
      // Flat kernels at vertices have one density at most of them, and so no such erosion.
      const bool is_flat = method == Method::uncontrolled && points == PointSource::vertices;
      for (int way = 0; way < (is_flat ? 3 : 4); ++way) {
        SCOPED_TRACE(std::string(name(method)) + " " + std::string(name(points)) + " " +
                     std::to_string(way));
        Options options = test::at(Preset::draft);
        options.method = method;
        options.points = points;
        if (way == 0) options.threshold = 0.5;
        if (way == 1) options.threshold_percent = 10;
        if (way == 2) options.coverage = 0.8;
        if (way == 3) options.erosion = 0.2;
        const Shape shape = alone(options), reported = extract(ash(), options, device());
        EXPECT_EQ(shape.mesh.positions, reported.mesh.positions);
        EXPECT_EQ(shape.mesh.normals, reported.mesh.normals);
        EXPECT_EQ(shape.mesh.triangles, reported.mesh.triangles);
        EXPECT_EQ(shape.report.threshold, reported.report.threshold);
        EXPECT_EQ(shape.report.warnings, reported.report.warnings);
        EXPECT_EQ(shape.report.counts.components, reported.report.counts.components);
        ASSERT_EQ(shape.kernels.size(), reported.kernels.size());
        EXPECT_EQ(shape.isotropic_density.empty(), !has_stage(shape, "isotropic density"));
        EXPECT_EQ(reported.isotropic_density.size(), reported.kernels.size());
        EXPECT_GT(reported.report.metrics.dilation, 0);
        EXPECT_GT(reported.report.covered, 0);
      }
    }
  }
}

TEST(Detail, SumsNothingAtTheLeavesThatNobodyNeeds) {
  Options options = test::at(Preset::draft);
  options.method = Method::isotropic;
  options.threshold = 0.5;
  const Shape shape = alone(options);
  EXPECT_FALSE(has_stage(shape, "isotropic density"));
  EXPECT_FALSE(has_stage(shape, "dilation"));
  EXPECT_FALSE(has_stage(shape, "metrics"));
  EXPECT_TRUE(has_stage(extract(ash(), options, device()), "metrics"));
}

TEST(Detail, ABandThatHasNoEffectIsNotRefused) {
  Options options = test::at(Preset::draft);
  options.band_low = 1;
  options.band_high_percent = 1;
  for (const Method method : {Method::isotropic, Method::uncontrolled, Method::controlled}) {
    options.method = method;
    for (const Detail detail : {Detail::shape, Detail::report}) {
      const auto run = [&] { (void)extract(ash(), options, device(), {}, detail); };
      if (method == Method::controlled) {
        EXPECT_THROW(run(), Error);
      } else {
        EXPECT_NO_THROW(run());
      }
    }
  }
}

TEST(Detail, AnEmptyShapeIsRefusedInTheSameWords) {
  Options options = test::at(Preset::draft);
  options.method = Method::isotropic;
  options.threshold = 1e9;
  const auto refusal = [&](Detail detail) {
    try {
      (void)extract(ash(), options, device(), {}, detail);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::empty);
      return std::string(error.what()) + error.remedy();
    }
    return std::string();
  };
  EXPECT_NE(refusal(Detail::shape), "");
  EXPECT_EQ(refusal(Detail::shape), refusal(Detail::report));
}

}  // namespace
}  // namespace leafhull
