// SPDX-License-Identifier: Apache-2.0
// Compares the two meshers, which share no code.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <vector>

#include "leafhull/shape.h"
#include "property/area_measures.h"

namespace leafhull {
namespace {

using test::volume;

/// The greatest distance from a vertex of `from` to the nearest one of `to` in the same or the next
/// voxel, in voxels; at most 1.
double greatest_distance(const Shape& from, const Shape& to) {
  const double h = from.report.voxel_size;
  const auto voxel = [](Vec3d p) {
    return std::array{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)),
                      static_cast<int>(std::floor(p.z))};
  };
  std::map<std::array<int, 3>, std::vector<Vec3d>> near;
  for (const Vec3f p : to.mesh.positions) near[voxel(Vec3d(p) / h)].push_back(Vec3d(p) / h);
  double greatest = 0;
  for (const Vec3f position : from.mesh.positions) {
    const Vec3d p = Vec3d(position) / h;
    const auto [x, y, z] = voxel(p);
    double least = 1;
    for (int i = 0; i < 27; ++i) {
      const auto found = near.find({x + i / 9 - 1, y + i / 3 % 3 - 1, z + i % 3 - 1});
      if (found == near.end()) continue;
      for (const Vec3d other : found->second) least = std::min(least, length(p - other));
    }
    greatest = std::max(greatest, least);
  }
  return greatest;
}

void expect_agreement(const std::filesystem::path& tree) {
  if (!std::filesystem::exists(tree)) GTEST_SKIP() << "SKIPPED: no " << tree;
  Device device({});
  const LeafSet leaves = find_leaves(read_tree(tree.string()), {});
  for (const Style style :
       {Style::painterly, Style::paper_thin, Style::paper_fat, Style::paper_previous}) {
    for (const bool snap : {false, true}) {
      Options options;
      options.style = style;
      options.snap = snap;
      options.mesher = Mesher::vdb;
      const Shape vdb = extract(leaves, options, device);
      options.mesher = Mesher::bricks;
      const Shape bricks = extract(leaves, options, device);
      EXPECT_EQ(bricks.report.counts.components, vdb.report.counts.components);
      EXPECT_EQ(bricks.mesh.positions.size(), vdb.mesh.positions.size());
      EXPECT_EQ(bricks.mesh.triangles.size(), vdb.mesh.triangles.size());
      EXPECT_NEAR(volume(bricks.mesh) / volume(vdb.mesh), 1, 1e-5);
      const double furthest = snap ? 0.02 : 1e-4;
      EXPECT_LT(greatest_distance(vdb, bricks), furthest);
      EXPECT_LT(greatest_distance(bricks, vdb), furthest);
    }
  }
}

TEST(Meshers, AgreeOnTheAsh) { expect_agreement(LEAFHULL_EXAMPLES "/ash.glb"); }
TEST(Meshers, AgreeOnTheBirch) { expect_agreement(LEAFHULL_SHARED_TREES "/birch.glb"); }

TEST(Meshers, OpenVdbsMakesTheSameMeshOfADenseField) {
  Device device({});
  const LeafSet leaves = find_leaves(read_tree(LEAFHULL_EXAMPLES "/ash.glb"), {});
  Options options;
  options.mesher = Mesher::vdb;
  const Mesh band = extract(leaves, options, device).mesh;
  options.dense = true;
  const Mesh dense = extract(leaves, options, device).mesh;
  EXPECT_EQ(band.triangles.size(), dense.triangles.size());
  EXPECT_EQ(band.positions, dense.positions);
  EXPECT_EQ(band.normals, dense.normals);
  EXPECT_EQ(band.triangles, dense.triangles);
}

}  // namespace
}  // namespace leafhull
