// SPDX-License-Identifier: Apache-2.0
// A whole study of a small tree, held against single extractions.
#include "leafhull/study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "study/plan.h"

namespace leafhull {
namespace {

Device& device() {
  static Device device({});
  return device;
}

/// Leaves of every direction in a ball, as many as `count`.
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

void expect_same(const Metrics& a, const Metrics& b) {
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
      expect_same(row.metrics, extracted(leaves, row, study.reading).metrics);
    }
    for (const auto& figure : {study.figure11, study.figure13, study.figure15}) {
      expect_same(figure[2].metrics, study.table1[2].metrics);
      expect_same(figure.back().metrics, extracted(leaves, figure.back(), study.reading).metrics);
    }
    ASSERT_EQ(study.table2.size(), 3U);
    for (const StudyTime& time : study.table2) {
      EXPECT_FALSE(time.empty);
      EXPECT_GT(time.previous, 0);
      EXPECT_GT(time.proposed, time.control);
      EXPECT_GT(time.control, 0);
    }
    EXPECT_EQ(study.verdicts.size(), verdicts(study).size());
  }
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
