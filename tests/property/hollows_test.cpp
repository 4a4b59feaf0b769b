// SPDX-License-Identifier: Apache-2.0
// The hollows of a whole shape are filled alike in everything made from it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "leafhull/series.h"
#include "leafhull/shape.h"
#include "leafhull/tree.h"
#include "pipeline/direct_surface.h"
#include "property/area_measures.h"
#include "property/extractions.h"

namespace leafhull {
namespace {

using test::device;
using test::expect_same;
using test::volume;

constexpr double kRadius = 10, kReach = 2, kThreshold = 1.5;

/// A crown whose leaves lie only on a sphere, with a hole of half-width `open` at the top.
LeafSet hollow_crown(double open = 0) {
  constexpr int kLeaves = 3000;
  LeafSet leaves;
  leaves.leaf_count = 1;
  leaves.mean_radius_major = 1;
  for (int i = 0; i < kLeaves; ++i) {  // a Fibonacci lattice
    const double y = 1 - (2 * i + 1.0) / kLeaves, r = std::sqrt(1 - y * y);
    const double turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const Vec3d p = Vec3d(r * std::cos(turn), y, r * std::sin(turn)) * kRadius;
    if (y > 0 && std::hypot(p.x, p.z) < open) continue;
    leaves.vertices.push_back({p, {0, 1, 0}, {1, 0, 0}, 1, 1, 0});
    leaves.bounds.include(p);
  }
  leaves.crown = leaves.bounds;
  return leaves;
}

Options hollows(Hollows hollows, double threshold = kThreshold) {
  Options options;
  options.points = PointSource::vertices;
  options.method = Method::isotropic;
  options.radius_unit = RadiusUnit::model;
  options.radius_max = kReach;
  options.threshold = threshold;
  options.voxel_size = 0.25;
  options.min_component = 0;
  options.hollows = hollows;
  return options;
}

double sphere(double radius) { return 4.0 / 3 * std::numbers::pi * std::pow(radius, 3); }

TEST(Hollows, OfACrownAreFilled) {
  const Shape kept = extract(hollow_crown(), hollows(Hollows::keep), device());
  const Shape filled = extract(hollow_crown(), hollows(Hollows::fill), device());
  EXPECT_EQ(kept.report.counts.components, 2u) << "an outer and an inner wall";
  EXPECT_EQ(filled.report.counts.components, 1u);
  double outer = 0;
  for (const Vec3f p : filled.mesh.positions) outer = std::max(outer, length(Vec3d(p)));
  EXPECT_NEAR(volume(filled.mesh) / sphere(outer), 1, 0.05);
  EXPECT_LT(volume(kept.mesh), 0.6 * sphere(outer));
  // The sphere's volume in voxels; half of the voxels on its surface count as inside.
  const Metrics& m = filled.report.metrics;
  const double voxels =
      static_cast<double>(m.inside_voxels) + 0.5 * static_cast<double>(m.on_voxels);
  EXPECT_NEAR(voxels * std::pow(0.25, 3) / volume(filled.mesh), 1, 0.02);
  EXPECT_LT(kept.report.metrics.inside_voxels, 0.6 * static_cast<double>(m.inside_voxels));
  EXPECT_EQ(m.off_site_exact, kept.report.metrics.off_site_exact);
}

TEST(Hollows, CountForTheDilationOnAnyLattice) {
  for (const Hollows choice : {Hollows::keep, Hollows::fill}) {
    Options options = hollows(choice);
    const double dilation = extract(hollow_crown(), options, device()).report.metrics.dilation;
    options.voxel_size.reset();
    options.preset = Preset::paper_64;
    EXPECT_EQ(extract(hollow_crown(), options, device()).report.metrics.dilation, dilation);
  }
}

TEST(Hollows, FillingLeavesTheOuterWallAlone) {
  Options options = hollows(Hollows::keep);
  for (const Mesher mesher : {Mesher::vdb, Mesher::bricks}) {
    options.mesher = mesher;
    const Mesh kept = extract(hollow_crown(), options, device()).mesh;
    options.hollows = Hollows::fill;
    const Mesh filled = extract(hollow_crown(), options, device()).mesh;
    options.hollows = Hollows::keep;
    std::vector<Vec3f> outer, normals;
    for (std::size_t v = 0; v < kept.positions.size(); ++v) {
      if (length(kept.positions[v]) < static_cast<float>(kRadius)) continue;
      outer.push_back(kept.positions[v]);
      normals.push_back(kept.normals[v]);
    }
    EXPECT_LT(outer.size(), kept.positions.size());
    EXPECT_EQ(filled.positions, outer);
    EXPECT_EQ(filled.normals, normals);
  }
}

TEST(Hollows, ThatAreOpenStay) {
  expect_same(extract(hollow_crown(4), hollows(Hollows::fill), device()),
              extract(hollow_crown(4), hollows(Hollows::keep), device()));
}

TEST(Hollows, AreFilledInADenseFieldAsInTheBand) {
  for (const Mesher mesher : {Mesher::vdb, Mesher::bricks}) {
    for (const double adaptivity : {0.0, 0.5}) {
      if (adaptivity > 0 && mesher == Mesher::bricks) continue;
      Options options = hollows(Hollows::fill);
      options.mesher = mesher;
      options.adaptivity = adaptivity;
      const Shape band = extract(hollow_crown(), options, device());
      options.dense = true;
      const Shape dense = extract(hollow_crown(), options, device());
      EXPECT_GT(dense.report.counts.evaluated_voxels, band.report.counts.evaluated_voxels);
      expect_same(dense, band);
    }
  }
}

TEST(Hollows, NeitherThreadsNorRunsMatter) {
  Device one({.choice = "", .threads = 1, .variant = ""});
  const Shape shape = extract(hollow_crown(), hollows(Hollows::fill), device());
  expect_same(extract(hollow_crown(), hollows(Hollows::fill), device()), shape);
  expect_same(extract(hollow_crown(), hollows(Hollows::fill), one), shape);
}

TEST(Hollows, OfARealTreeAreTheSameInADenseField) {
  const LeafSet ash = find_leaves(read_tree(LEAFHULL_EXAMPLES "/ash.glb"), {});
  Options options;
  options.points = PointSource::vertices;
  options.threshold_percent = 30;
  options.hollows = Hollows::keep;
  const Shape kept = extract(ash, options, device());
  options.hollows = Hollows::fill;
  const Shape band = extract(ash, options, device());
  EXPECT_GT(band.report.metrics.inside_voxels, kept.report.metrics.inside_voxels);
  options.dense = true;
  expect_same(extract(ash, options, device()), band);
}

TEST(Hollows, OfASeriesAreThoseOfEachEntry) {
  std::vector<Options> series;
  for (const double threshold : {1.0, 1.5, 2.0}) {
    for (const Hollows each : {Hollows::fill, Hollows::keep}) {
      series.push_back(hollows(each, threshold));
      series.back().snap = false;
    }
  }
  std::size_t entries = 0;
  extract_series(hollow_crown(), series, device(), [&](std::size_t index, SeriesEntry&& entry) {
    const Shape alone = extract(hollow_crown(), series[index], device());
    EXPECT_EQ(entry.mesh.positions, alone.mesh.positions);
    EXPECT_EQ(entry.mesh.triangles, alone.mesh.triangles);
    EXPECT_EQ(entry.report.metrics.inside_voxels, alone.report.metrics.inside_voxels);
    EXPECT_EQ(entry.report.metrics.dilated_voxels, alone.report.metrics.dilated_voxels);
    EXPECT_EQ(entry.report.counts.components, index % 2 == 0 ? 1u : 2u);
    ++entries;
    return true;
  });
  EXPECT_EQ(entries, series.size());
}

TEST(Hollows, RaysFromWithinPassTheirWalls) {
  const auto distance = [&](Hollows each) {
    const DirectSurface surface(hollow_crown(), hollows(each), device());
    const VoxelRay ray{Vec3f(surface.lattice().local({0, 0, 0})), {0.6f, 0.8f, 0}};
    VoxelHit hit{};
    surface.caster().closest({&ray, 1}, {&hit, 1});
    return static_cast<double>(hit.distance) * surface.lattice().voxel_size;
  };
  EXPECT_LT(distance(Hollows::keep), kRadius);
  EXPECT_GT(distance(Hollows::fill), kRadius);
  EXPECT_LT(distance(Hollows::fill), kRadius + kReach);
}

}  // namespace
}  // namespace leafhull
