// SPDX-License-Identifier: Apache-2.0
// Each entry of a series must report the same as a single extraction.
#include "leafhull/series.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "leafhull/error.h"
#include "leafhull/tree.h"
#include "property/extractions.h"

namespace leafhull {
namespace {

using test::ash;
using test::device;

Options thin(double threshold) {
  Options options;
  options.style = Style::paper_thin;
  options.preset = Preset::draft;
  options.threshold = threshold;
  return options;
}

std::map<std::size_t, SeriesEntry> entries_of(std::span<const Options> series) {
  std::map<std::size_t, SeriesEntry> entries;
  extract_series(ash(), series, device(), [&](std::size_t index, SeriesEntry&& entry) {
    EXPECT_TRUE(entries.emplace(index, std::move(entry)).second);
    return true;
  });
  return entries;
}

void expect_as_alone(const SeriesEntry& entry, const Options& options) {
  const Shape alone = extract(ash(), options, device());
  const Report &a = entry.report, &b = alone.report;
  EXPECT_EQ(a.threshold, b.threshold);
  EXPECT_EQ(a.voxel_size, b.voxel_size);
  EXPECT_EQ(a.density.mean, b.density.mean);
  EXPECT_EQ(a.density.p1, b.density.p1);
  EXPECT_EQ(a.density.p2, b.density.p2);
  EXPECT_EQ(a.metrics.dilated_voxels, b.metrics.dilated_voxels);
  EXPECT_EQ(a.metrics.inside_voxels, b.metrics.inside_voxels);
  EXPECT_EQ(a.metrics.on_voxels, b.metrics.on_voxels);
  EXPECT_EQ(a.metrics.off_site_exact, b.metrics.off_site_exact);
  EXPECT_EQ(a.metrics.off_site_sampled, b.metrics.off_site_sampled);
  EXPECT_EQ(a.counts.mesh_vertices, b.counts.mesh_vertices);
  EXPECT_EQ(a.counts.mesh_triangles, b.counts.mesh_triangles);
  EXPECT_EQ(a.counts.components, b.counts.components);
  EXPECT_EQ(a.counts.dropped_components, b.counts.dropped_components);
  EXPECT_EQ(entry.mesh.positions.size(), alone.mesh.positions.size());
  EXPECT_EQ(entry.mesh.normals.size(), alone.mesh.positions.size());
  EXPECT_EQ(entry.mesh.triangles.size(), alone.mesh.triangles.size());
}

TEST(Series, SaysOfEachEntryWhatAnExtractionSays) {
  std::vector<Options> series;
  for (const Method method : {Method::controlled, Method::isotropic, Method::uncontrolled}) {
    for (const double radius : {1.5, 2.5}) {
      for (const double threshold : {3.0, 0.5, 1.5}) {
        series.push_back(thin(threshold));
        series.back().method = method;
        series.back().radius_max = radius;
      }
    }
  }
  const auto add = [&](auto&& change) {
    series.push_back(thin(2));
    change(series.back());
  };
  add([](Options& o) { o.mesher = Mesher::vdb; });
  add([](Options& o) { o.adaptivity = 0.5; });
  add([](Options& o) { o.dense = true; });
  add([](Options& o) { o.density = DensitySource::grid; });
  add([](Options& o) { o.falloff = 1; });
  add([](Options& o) { o.spread = Spread::variance; });
  add([](Options& o) { o.min_component = 0.1; });
  add([](Options& o) { o.hollows = Hollows::fill; });
  add([](Options& o) { o.preset = Preset::paper_32; });
  add([](Options& o) { o.band_low = -0.5; });
  add([](Options& o) { o.band_high = 1; });
  add([](Options& o) { o.band_high_percent = 60; });
  add([](Options& o) { o.flatness = 0.3; });
  add([](Options& o) { o.points = PointSource::area; });
  add([](Options& o) { o.points = PointSource::area, o.point_spacing = 0.2; });
  add([](Options& o) { o.radius_max = 1.9, o.radius_unit = RadiusUnit::model; });
  add([](Options& o) { o.threshold.reset(), o.coverage = 0.8; });
  add([](Options& o) { o.threshold.reset(), o.threshold_percent = 60; });
  const auto entries = entries_of(series);
  ASSERT_EQ(entries.size(), series.size());
  for (const auto& [index, entry] : entries) {
    SCOPED_TRACE(index);
    EXPECT_FALSE(entry.empty());
    expect_as_alone(entry, series[index]);
  }
}

TEST(Series, OneFieldServesAllThresholds) {
  const std::vector<Options> series{thin(1), thin(1.1), thin(1.2), thin(1.3), thin(1.4)};
  std::uint64_t alone = 0;
  for (const Options& options : series) {
    alone += extract(ash(), options, device()).report.counts.evaluated_voxels;
  }
  for (const auto& [index, entry] : entries_of(series)) {
    EXPECT_LT(entry.report.counts.evaluated_voxels, alone / 3);
  }
}

TEST(Series, NineThresholdsCostLessThanThreeExtractions) {
  std::vector<Options> series;
  for (int i = 0; i < 9; ++i) series.push_back(thin(1.5 + 0.125 * i));
  const Counts alone = extract(ash(), series[4], device()).report.counts;
  for (const auto& [index, entry] : entries_of(series)) {
    EXPECT_LT(entry.report.counts.evaluated_voxels, 3 * alone.evaluated_voxels);
    EXPECT_LT(entry.report.counts.evaluated_pairs, 3 * alone.evaluated_pairs);
  }
}

TEST(Series, AnEntryThatCannotBeComputedSaysWhy) {
  std::vector<Options> series{thin(2), thin(2), thin(1)};
  series[1].preset.reset();
  series[1].resolution = 900'000;
  const auto entries = entries_of(series);
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_NE(entries.at(1).failure.find("GiB"), std::string::npos) << entries.at(1).failure;
  EXPECT_TRUE(entries.at(1).empty());
  for (const std::size_t other : {0, 2}) {
    EXPECT_EQ(entries.at(other).failure, "");
    expect_as_alone(entries.at(other), series[other]);
  }
}

TEST(Series, AnEntryWithoutASurfaceIsEmpty) {
  const std::vector<Options> series{thin(1e6), thin(2)};
  const auto entries = entries_of(series);
  ASSERT_EQ(entries.size(), 2u);
  const SeriesEntry& empty = entries.at(0);
  EXPECT_TRUE(empty.empty());
  EXPECT_EQ(empty.report.threshold, 1e6);
  EXPECT_EQ(empty.report.counts.components, 0u);
  EXPECT_EQ(empty.report.metrics.dilated_voxels, 0u);
  EXPECT_EQ(empty.report.metrics.off_site_exact, ash().vertices.size());
  EXPECT_EQ(empty.report.metrics.off_site_sampled, ash().vertices.size());
  expect_as_alone(entries.at(1), series[1]);
}

TEST(Series, EndsWhereTheVisitorSaysSo) {
  const std::vector<Options> series{thin(1), thin(2), thin(3)};
  int visits = 0;
  extract_series(ash(), series, device(), [&](std::size_t, SeriesEntry&&) { return ++visits < 2; });
  EXPECT_EQ(visits, 2);
}

TEST(Series, RefusesBadOptionsBeforeItBegins) {
  std::vector<Options> series{thin(1), thin(2)};
  series.back().flatness = 1.5;
  int visits = 0;
  try {
    extract_series(ash(), series, device(), [&](std::size_t, SeriesEntry&&) { return ++visits; });
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
  }
  EXPECT_EQ(visits, 0);
}

TEST(Series, ItsMeshIsTheLatticesSurface) {
  Options options;
  options.preset = Preset::draft;
  options.snap = false;
  const std::vector<Options> series{options};
  const auto entries = entries_of(series);
  const Shape alone = extract(ash(), options, device());
  EXPECT_EQ(entries.at(0).mesh.positions, alone.mesh.positions);
  EXPECT_EQ(entries.at(0).mesh.triangles, alone.mesh.triangles);
  double agreement = 0;
  for (std::size_t v = 0; v < alone.mesh.normals.size(); ++v) {
    const Vec3f normal = entries.at(0).mesh.normals[v];
    EXPECT_NEAR(length(normal), 1, 1e-5);
    agreement += static_cast<double>(dot(normal, alone.mesh.normals[v]));
  }
  EXPECT_GT(agreement / static_cast<double>(alone.mesh.normals.size()), 0.9);
}

}  // namespace
}  // namespace leafhull
