// SPDX-License-Identifier: Apache-2.0
// Compares a whole study of a small tree with single extractions.
#include "leafhull/study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "property/extractions.h"
#include "study/band_study.h"
#include "study/study_plan.h"

namespace leafhull {
namespace {

using test::device;

/// `count` leaves in random directions in a ball.
LeafSet ball(std::size_t count, float radius_major) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  LeafSet leaves;
  for (std::size_t i = 0; i < count; ++i) {
    const auto draw = [&] { return Vec3d{normal(random), normal(random), normal(random)}; };
    const Vec3d up = normalized(draw());
    const Vec3d along = normalized(cross(up, normalized(draw())));
    leaves.vertices.push_back({normalized(draw()) * 3.0 * std::cbrt((i + 0.5) / count), Vec3f(up),
                               Vec3f(along), radius_major, radius_major / 2,
                               static_cast<std::uint32_t>(i)});
    leaves.bounds.include(leaves.vertices.back().position);
  }
  leaves.crown = leaves.bounds;
  leaves.leaf_count = count;
  leaves.mean_radius_major = static_cast<double>(radius_major);
  return leaves;
}

Report extracted(const LeafSet& leaves, const StudyRow& row, const Reading& reading) {
  return extract(leaves, options_of(row, reading), device()).report;
}

void expect_same_metrics(const Metrics& a, const Metrics& b) {
  EXPECT_EQ(a.dilated_voxels, b.dilated_voxels);
  EXPECT_EQ(a.inside_voxels, b.inside_voxels);
  EXPECT_EQ(a.on_voxels, b.on_voxels);
  EXPECT_EQ(a.off_site_exact, b.off_site_exact);
  EXPECT_EQ(a.off_site_sampled, b.off_site_sampled);
}

TEST(StudyTree, IsWhatSingleExtractionsAre) {
  const LeafSet leaves = ball(14000, 0.2F);
  std::vector<double> progress;
  const TreeStudy tree = study_tree(
      leaves, "ball", device(), [&](std::string_view, double done) { progress.push_back(done); });
  EXPECT_EQ(tree.name, "ball");
  EXPECT_EQ(tree.leaf_vertices, leaves.vertices.size());
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  EXPECT_EQ(progress.front(), 0);
  EXPECT_EQ(progress.back(), 1);

  ASSERT_EQ(tree.readings.size(), readings().size());
  for (const ReadingStudy& study : tree.readings) {
    for (const StudyRow& row : study.table1) {
      ASSERT_FALSE(row.empty);
      expect_same_metrics(row.metrics, extracted(leaves, row, study.reading).metrics);
    }
    for (const auto& figure : {study.figure11, study.figure13, study.figure15}) {
      expect_same_metrics(figure[2].metrics, study.table1[2].metrics);
      expect_same_metrics(figure.back().metrics,
                          extracted(leaves, figure.back(), study.reading).metrics);
    }
    ASSERT_EQ(study.table2.size(), 3U);
    for (const StudyTime& time : study.table2) {
      EXPECT_FALSE(time.empty);
      EXPECT_GT(time.previous, 0);
      EXPECT_GT(time.proposed, time.control);
      EXPECT_GT(time.control, 0);
    }
    EXPECT_EQ(study.verdicts.size(), verdicts(study).size());
    const bool own = &study == &tree.readings.front();
    for (const Verdict& verdict : study.verdicts) {
      const bool tells = verdict.figures.find("“Where the band lies”") != std::string::npos;
      EXPECT_EQ(tells, own && verdict.number == "2b") << verdict.figures;
    }
  }
  EXPECT_EQ(tree.band.failure, "");
  const std::size_t pictures =
      tree.methods.size() + tree.figure12.size() + tree.figure14.size() + tree.figure16.size();
  EXPECT_EQ(pictures, 12U);
  EXPECT_TRUE(tree.methods[2].picture.rgb == tree.figure12[1].picture.rgb) << "one place";
  EXPECT_FALSE(tree.methods[0].picture.rgb == tree.methods[1].picture.rgb);
  for (std::size_t i = 0; i < tree.meshes.size(); ++i) {
    const Report report = extracted(leaves, tree.readings[0].table1[i], tree.readings[0].reading);
    EXPECT_EQ(tree.meshes[i].positions.size(), report.counts.mesh_vertices);
  }
}

/// The leaves as `--leaf-scale` would have read them.
LeafSet scaled(LeafSet leaves, double scale) {
  for (LeafVertex& vertex : leaves.vertices) {
    vertex.radius_major *= static_cast<float>(scale);
    vertex.radius_minor *= static_cast<float>(scale);
  }
  return leaves;
}

TEST(StudyBand, LosesWhatThePaperLoses) {
  const LeafSet leaves = ball(14000, 0.2F);
  const BandStudy band = study_band(leaves, device());
  ASSERT_EQ(band.failure, "");
  const auto lost = [&](const StudyRow& row) { return share_lost(row, leaves.vertices.size()); };
  EXPECT_NEAR(lost(band.isotropic), 172.0 / 52648, 1e-3);
  EXPECT_NEAR(lost(band.uncontrolled), 24766.0 / 52648, 1e-3);
  EXPECT_EQ(band.isotropic.threshold, band.threshold);
  EXPECT_EQ(band.uncontrolled.threshold, band.threshold);

  const Report isotropic = extracted(leaves, band.isotropic, kBandReading);
  expect_same_metrics(band.isotropic.metrics, isotropic.metrics);
  EXPECT_DOUBLE_EQ(band.evenness, std::sqrt(isotropic.density.variance) / isotropic.density.mean);
  const LeafSet fitted = scaled(leaves, band.leaf_scale);
  expect_same_metrics(band.uncontrolled.metrics,
                      extracted(fitted, band.uncontrolled, kBandReading).metrics);
  // The first band is that of Eqs. (9) and (10), a row's default.
  const StudyRow& usual = band.by_deviation.front().row;
  expect_same_metrics(usual.metrics, extracted(fitted, usual, kBandReading).metrics);
}

TEST(StudyBand, GoesFromOneEndToTheOther) {
  const BandStudy band = study_band(ball(14000, 0.2F), device());
  ASSERT_EQ(band.failure, "");
  EXPECT_EQ(name(band.by_share.front().band), "80–100%");
  EXPECT_EQ(name(band.by_share.back().band), "0–20%");
  EXPECT_EQ(name(band.by_deviation.front().band), "0 to 2 s");
  EXPECT_EQ(name(band.by_deviation.back().band), "-1 to -0.5 s");
  for (const auto* rows : {&band.by_share, &band.by_deviation}) {
    std::vector<StudyRow> way{band.isotropic};
    for (const BandRow& row : *rows) way.push_back(row.row);
    way.push_back(band.uncontrolled);
    for (std::size_t i = 1; i < way.size(); ++i) {
      EXPECT_GE(way[i].off_site(), way[i - 1].off_site());
      EXPECT_LE(share_dilated(way[i], way[0]), share_dilated(way[i - 1], way[0]));
    }
  }
}

TEST(StudyBand, SaysWhatCannotBeFitted) {
  // With leaves in two places, all leaf vertices have the same density.
  LeafSet leaves = ball(2, 0.2F);
  const LeafVertex first = leaves.vertices[0], second = leaves.vertices[1];
  for (int i = 0; i < 50; ++i) {
    leaves.vertices.push_back(first);
    leaves.vertices.push_back(second);
  }
  const BandStudy band = study_band(leaves, device());
  EXPECT_NE(band.failure.find("of the leaf vertices"), std::string::npos) << band.failure;
  EXPECT_TRUE(band.by_share.empty());
  EXPECT_TRUE(band.by_deviation.empty());
}

TEST(StudyTree, OfWhichNothingIsDenseEnough) {
  const LeafSet leaves = ball(40, 0.01F);
  const TreeStudy tree = study_tree(leaves, "bare", device());
  for (const ReadingStudy& study : tree.readings) {
    for (const StudyRow& row : study.table1) {
      EXPECT_TRUE(row.empty);
      EXPECT_EQ(row.metrics.dilated_voxels, 0U);
      EXPECT_EQ(row.off_site(), leaves.vertices.size());
    }
    for (const StudyTime& time : study.table2) EXPECT_TRUE(time.empty);
    for (const Verdict& verdict : study.verdicts) {
      EXPECT_EQ(verdict.outcome, Outcome::open) << verdict.number;
    }
  }
  for (const Mesh& mesh : tree.meshes) EXPECT_TRUE(mesh.positions.empty());
  EXPECT_EQ(tree.methods[0].lines, (std::vector<std::string>{"L&D", "no surface"}));
}

}  // namespace
}  // namespace leafhull
