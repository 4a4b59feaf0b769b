// SPDX-License-Identifier: Apache-2.0
// Whole shapes of trees with closed crowns, as low-poly trees have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "leafhull/shape.h"
#include "property/area_measures.h"
#include "property/area_trees.h"
#include "property/canopies.h"
#include "property/extractions.h"
#include "tiles/compute_tile.h"
#include "tiles/tile_plan.h"

namespace leafhull {
namespace {

using test::at;
using test::canopy;
using test::Corners;
using test::device;
using test::placed;
using test::shape_of;
using test::share_outside;
using test::volume;

/// A lumpy crown of 80 faces, about 4 wide and 5 high.
TreeModel low_poly_crown() {
  TreeModel tree = test::closed_sphere();
  for (Vec3f& p : tree.primitives[0].positions) {
    const Vec3d d(p);
    const double lump = 1 + 0.12 * std::sin(2 * d.x + 1) + 0.1 * std::cos(1.7 * d.z + d.y);
    p = Vec3f(Vec3d(d.x * lump, 1.25 * d.y * lump + 6, d.z * lump));
  }
  return tree;
}

std::vector<Corners> faces_of(const TreeModel& tree) {
  std::vector<Corners> faces;
  const Primitive& p = tree.primitives[0];
  for (const auto& [a, b, c] : p.triangles) {
    faces.push_back({Vec3d(p.positions[a]), Vec3d(p.positions[b]), Vec3d(p.positions[c])});
  }
  return faces;
}

TEST(ClosedCrown, IsOneFullPieceAboutAsLargeAsItself) {
  const TreeModel tree = low_poly_crown();
  const double own = volume(faces_of(tree));
  for (const Style style : {Style::painterly, Style::fat, Style::previous}) {
    SCOPED_TRACE(name(style));
    Options options = at(Preset::draft);
    options.style = style;
    const Shape shape = shape_of(tree, options);
    EXPECT_EQ(shape.report.counts.components, 1u);
    EXPECT_GT(volume(shape.mesh), 0.9 * own);
    EXPECT_LT(volume(shape.mesh), (style == Style::fat ? 2 : 1.6) * own);
    options.hollows = Hollows::keep;
    const Shape kept = shape_of(tree, options);
    EXPECT_EQ(kept.report.counts.components + kept.report.counts.dropped_components, 1u)
        << "nothing had to be filled";
    EXPECT_EQ(kept.mesh.positions, shape.mesh.positions);
  }
}

TEST(ClosedCrown, HoldsItsMiddle) {
  const TreeModel tree = low_poly_crown();
  const Shape shape = shape_of(tree, at(Preset::draft));
  const test::Solid solid(test::corners_of(shape.mesh), 2 * shape.report.voxel_size);
  const test::Solid crown(faces_of(tree), 1);
  const test::Layers layers(shape);
  test::Random random(2);
  int seen = 0;
  while (seen < 2000) {
    const Vec3d p = Vec3d(0, 6, 0) + random.in_ball(3);
    if (!crown.holds(p)) continue;
    ++seen;
    EXPECT_TRUE(solid.holds(p) || layers(p) < 1.05 * shape.report.threshold);
  }
}

TEST(ClosedCrown, IsErodedByWhatACoverageLeavesOut) {
  const TreeModel tree = low_poly_crown();
  for (const double coverage : {0.5, 0.8, 0.9}) {
    SCOPED_TRACE(coverage);
    Options options = at(Preset::standard);
    options.coverage = coverage;
    const Shape shape = shape_of(tree, options);
    EXPECT_NEAR(share_outside(test::places_on(tree, 10000), shape), 1 - coverage, 0.02);
    EXPECT_NEAR(shape.report.covered, coverage, 0.005);
    EXPECT_EQ(shape.report.counts.components, 1u);
  }
}

TEST(ClosedCrown, TakesInNearlyAllWhereThatIsAskedFor) {
  const TreeModel tree = low_poly_crown();
  double last = 0;
  for (const double coverage : {0.95, 0.98, 0.99}) {
    SCOPED_TRACE(coverage);
    Options options = at(Preset::draft);
    options.coverage = coverage;
    const Shape shape = shape_of(tree, options);
    EXPECT_LT(share_outside(test::places_on(tree, 10000), shape), 0.01);
    EXPECT_GT(volume(shape.mesh), last);
    last = volume(shape.mesh);
  }
}

TEST(ClosedCrown, MayBeTessellatedInAnyWay) {
  const TreeModel tree = low_poly_crown();
  const Options options = at(Preset::draft);
  const Shape plain = shape_of(tree, options);
  const auto split = [](const Primitive& p) { return test::with_split_vertices(p); };
  const auto fine = [](const Primitive& p) { return test::in_quarters(p); };
  const auto fine_split = [](const Primitive& p) {
    return test::with_split_vertices(test::in_quarters(p));
  };
  const std::pair<const char*, TreeModel> others[] = {
      {"in four", test::with_primitives(tree, fine)},
      {"split vertices", test::with_primitives(tree, split)},
      {"in four, split", test::with_primitives(tree, fine_split)}};
  for (const auto& [how, other] : others) {
    SCOPED_TRACE(how);
    const Shape shape = shape_of(other, options);
    EXPECT_NEAR(volume(shape.mesh) / volume(plain.mesh), 1, 0.01);
    EXPECT_EQ(shape.report.counts.components, 1u);
  }
  EXPECT_EQ(shape_of(others[1].second, options).mesh.positions, plain.mesh.positions)
      << "vertices at one place are one";
}

TEST(ClosedCrown, IsFilledWhicheverWayItsFacesAreTurned) {
  const TreeModel tree = low_poly_crown();
  const Shape plain = shape_of(tree, at(Preset::draft));
  const auto inward = [](Primitive p) {
    for (auto& [a, b, c] : p.triangles) std::swap(b, c);
    return p;
  };
  const Shape turned = shape_of(test::with_primitives(tree, inward), at(Preset::draft));
  EXPECT_EQ(turned.report.counts.components, 1u);
  EXPECT_NEAR(volume(turned.mesh) / volume(plain.mesh), 1, 0.005);
}

TEST(ClosedCrown, OfCubesIsOneCrown) {
  // Two boxes in a row, one on top and one behind; the faces between them are doubled.
  TreeModel tree = test::closed_box();
  const Primitive cube = tree.primitives[0];
  Primitive all;
  for (const Vec3f place : {Vec3f(0, 0, 0), {3, 0, 0}, {3, 2, 0}, {0, 0, 2}}) {
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    for (const Vec3f& p : cube.positions) all.positions.push_back(p + place);
    for (const auto& [a, b, c] : cube.triangles) {
      all.triangles.push_back({first + a, first + b, first + c});
    }
  }
  all.material = 0;
  tree.primitives[0] = all;
  const Shape shape = shape_of(tree, at(Preset::draft));
  EXPECT_EQ(shape.report.counts.components, 1u);
  EXPECT_GT(volume(shape.mesh), 0.9 * 48);
  EXPECT_LT(volume(shape.mesh), 1.6 * 48);
}

/// The triangles of all tiles of a forest with that tree, in world coordinates.
std::vector<Corners> canopy_of_crown(const PlacedTree& tree, const Options& options, int edge) {
  Scene scene;
  scene.models.resize(1);
  scene.trees = {tree};
  const std::vector<LeafSet> models{find_leaves(low_poly_crown(), {})};
  const std::vector<Options> shapes{options};
  const ForestLevel level =
      prepare_level(0, scene, models, shapes, *options.voxel_size, nullptr, device());
  return canopy(level, edge);
}

TEST(ClosedCrown, IsTheSameInAForest) {
  ForestOptions forest;
  forest.shape.min_component = 0;  // tiles alone do not show how large a piece over seams is
  Options options = resolved_shape(forest);
  options.preset.reset(), options.resolution.reset();
  options.voxel_size = 0.08;
  const double alone = volume(shape_of(low_poly_crown(), options).mesh);
  for (const int edge : {32, 512}) {
    EXPECT_NEAR(volume(canopy_of_crown(placed(0, {}, 0, 1), options, edge)) / alone, 1, 0.002);
  }
  EXPECT_NEAR(volume(canopy_of_crown(placed(0, {7, 1, -3}, 0.6, 1), options, 64)) / alone, 1,
              0.005);
}

}  // namespace
}  // namespace leafhull
