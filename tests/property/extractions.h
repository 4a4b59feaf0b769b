// SPDX-License-Identifier: Apache-2.0
// Inputs and comparisons that many tests of whole extractions share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

#include "leafhull/shape.h"
#include "leafhull/tree.h"
#include "property/area_measures.h"

namespace leafhull::test {

inline Device& device() {
  static Device device({});
  return device;
}

/// The leaves of the example tree.
inline const LeafSet& ash() {
  static const LeafSet leaves = find_leaves(read_tree(LEAFHULL_EXAMPLES "/ash.glb"), {});
  return leaves;
}

inline Options at(Preset preset) {
  Options options;
  options.preset = preset;
  return options;
}

inline Shape shape_of(const TreeModel& tree, const Options& options) {
  return extract(find_leaves(tree, {}), options, device());
}

/// The share of the points that lie outside a mesh, computed without leafhull's code.
inline double share_outside(std::span<const Vec3d> places, const Shape& shape) {
  const Solid solid(corners_of(shape.mesh), 2 * shape.report.voxel_size);
  const auto outside = std::ranges::count_if(places, [&](Vec3d p) { return !solid.holds(p); });
  return static_cast<double>(outside) / static_cast<double>(places.size());
}

inline void expect_same(const Shape& a, const Shape& b) {
  EXPECT_EQ(a.mesh.positions, b.mesh.positions);
  EXPECT_EQ(a.mesh.normals, b.mesh.normals);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.report.metrics.dilated_voxels, b.report.metrics.dilated_voxels);
  EXPECT_EQ(a.report.metrics.inside_voxels, b.report.metrics.inside_voxels);
  EXPECT_EQ(a.report.metrics.on_voxels, b.report.metrics.on_voxels);
  EXPECT_EQ(a.report.metrics.off_site_exact, b.report.metrics.off_site_exact);
  EXPECT_EQ(a.report.metrics.off_site_sampled, b.report.metrics.off_site_sampled);
}

}  // namespace leafhull::test
