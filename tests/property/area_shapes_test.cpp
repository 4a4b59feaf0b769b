// SPDX-License-Identifier: Apache-2.0
// Whole shapes made from leaf area: they do not depend on how leaves are tessellated, are masses
// and not crumbs, and have the same bytes however they are computed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "leafhull/series.h"
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
using test::expect_same;
using test::placed;
using test::shape_of;
using test::volume;

TreeModel ash_tree() { return read_tree(LEAFHULL_EXAMPLES "/ash.glb"); }

struct TreeKind {
  const char* name;
  TreeModel (*tree)();
};
const TreeKind kTreeKinds[] = {{"cards", [] { return test::card_tree(); }},
                               {"needles", test::needle_tree},
                               {"sphere", test::closed_sphere},
                               {"box", test::closed_box},
                               {"sheet", test::curved_sheet},
                               {"billboard", test::crossed_billboard},
                               {"ash", ash_tree}};

class Tessellation : public testing::TestWithParam<TreeKind> {};
INSTANTIATE_TEST_SUITE_P(Trees, Tessellation,
                         testing::Values(kTreeKinds[0], kTreeKinds[2], kTreeKinds[3],
                                         kTreeKinds[4]),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST_P(Tessellation, OfLeavesDoesNotShow) {
  const TreeModel tree = GetParam().tree();
  const Options options = at(Preset::draft);
  const Shape plain = shape_of(tree, options);
  const auto fine = [](const Primitive& p) { return test::in_quarters(p); };
  const auto finer = [](const Primitive& p) { return test::in_quarters(test::in_quarters(p)); };
  const auto fine_split = [](const Primitive& p) {
    return test::with_split_vertices(test::in_quarters(p));
  };
  const std::pair<const char*, TreeModel> others[] = {
      {"in four", test::with_primitives(tree, fine)},
      {"in sixteen", test::with_primitives(tree, finer)},
      {"split vertices", test::with_primitives(tree, test::with_split_vertices)},
      {"in four, split", test::with_primitives(tree, fine_split)},
      {"other diagonals", test::with_primitives(tree, test::along_the_other_diagonal)},
  };
  // T of a single sheet is N at its rim, which one point more or less changes: by 1.5% and 0.06
  // voxels, as measured.
  const double volumes = GetParam().tree == test::curved_sheet ? 0.02 : 0.01;
  for (const auto& [how, other] : others) {
    SCOPED_TRACE(how);
    const Shape shape = shape_of(other, options);
    const double h = plain.report.voxel_size;
    EXPECT_NEAR(volume(shape.mesh) / volume(plain.mesh), 1, volumes);
    EXPECT_LT(test::distance_between(shape.mesh, plain.mesh, 2 * h), 0.5 * h);
    EXPECT_LT(test::distance_between(plain.mesh, shape.mesh, 2 * h), 0.5 * h);
  }
}

TEST(Tessellation, OfASheetIntoTrianglesOfOnePointDoesNotShow) {
  Options options = at(Preset::paper_32);
  options.method = Method::uncontrolled;
  TreeModel tree = test::curved_sheet();
  const Shape plain = shape_of(tree, options);
  for (int i = 0; i < 3; ++i) tree = test::with_primitives(tree, test::in_quarters);
  const Shape shape = shape_of(tree, options);
  EXPECT_NEAR(volume(shape.mesh) / volume(plain.mesh), 1, 0.05);
  EXPECT_LT(test::distance_between(plain.mesh, shape.mesh, shape.report.voxel_size),
            0.5 * shape.report.voxel_size);
}

class Mass : public testing::TestWithParam<TreeKind> {};
INSTANTIATE_TEST_SUITE_P(Trees, Mass, testing::ValuesIn(kTreeKinds),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST_P(Mass, IsOfFewPiecesAndFillsItsBox) {
  const LeafSet leaves = find_leaves(GetParam().tree(), {});
  const Shape shape = extract(leaves, {}, device());
  const Vec3d size = leaves.crown.size();
  EXPECT_LE(shape.report.counts.components, 20u);
  EXPECT_GE(volume(shape.mesh) / (size.x * size.y * size.z), 0.03);
}

TEST(Mass, OfACrossedBillboardIsItsVisiblePart) {
  const Shape shape = shape_of(test::crossed_billboard(), {});
  EXPECT_EQ(shape.report.counts.components, 1u);
  Box box;
  for (const Vec3f p : shape.mesh.positions) box.include(Vec3d(p));
  // Only the mask's ellipse is visible.
  const double r = shape.report.radius_max_model;
  for (const auto& [side, visible] : {std::pair{-box.low.x, 0.8},
                                      {box.high.x, 0.6},
                                      {-box.low.z, 0.8},
                                      {box.high.z, 0.6},
                                      {-box.low.y, 0.9},
                                      {box.high.y, 0.7}}) {
    EXPECT_NEAR(side, visible, r);
  }
}

int euler_characteristic(const Mesh& mesh) {
  return static_cast<int>(mesh.positions.size()) - static_cast<int>(mesh.triangles.size()) / 2;
}

TEST(Mass, OfAClosedCrownIsSolid) {
  for (const TreeModel& tree : {test::closed_sphere(), test::closed_box()}) {
    std::vector<Corners> walls;
    const Primitive& p = tree.primitives[0];
    for (const auto& [a, b, c] : p.triangles) {
      walls.push_back({Vec3d(p.positions[a]), Vec3d(p.positions[b]), Vec3d(p.positions[c])});
    }
    const Shape shape = shape_of(tree, {});
    EXPECT_EQ(shape.report.counts.components, 1u);
    EXPECT_EQ(euler_characteristic(shape.mesh), 2);
    // The shape holds the solid and a wall outside it that is thinner than R_max.
    double area = 0;
    for (const auto& [a, b, c] : walls) area += length(cross(b - a, c - a)) / 2;
    EXPECT_GT(volume(shape.mesh), volume(walls));
    EXPECT_LT(volume(shape.mesh), volume(walls) + 0.6 * area * shape.report.radius_max_model);
  }
}

void expect_same_with_density(const Shape& a, const Shape& b) {
  expect_same(a, b);
  EXPECT_EQ(a.isotropic_density, b.isotropic_density);
  EXPECT_EQ(a.report.threshold, b.report.threshold);
}

TEST(AreaBytes, AreTheSameDenseOnAnyThreadsAndAgain) {
  Device one({.choice = "", .threads = 1, .variant = ""});
  for (const TreeModel& tree : {ash_tree(), test::card_tree(), test::closed_sphere()}) {
    const LeafSet leaves = find_leaves(tree, {});
    Options options = at(Preset::draft);
    const Shape shape = extract(leaves, options, device());
    EXPECT_FALSE(shape.mesh.triangles.empty());
    expect_same_with_density(shape_of(tree, options), shape);
    expect_same_with_density(extract(leaves, options, one), shape);
    options.dense = true;
    const Shape dense = extract(leaves, options, device());
    EXPECT_GT(dense.report.counts.evaluated_voxels, shape.report.counts.evaluated_voxels);
    expect_same_with_density(dense, shape);
  }
}

/// Cards inside a crown of cards, with a gap between.
TreeModel crown_with_a_hollow() {
  TreeModel tree = test::sphere_of_cards();
  tree.instances.push_back({1, "node"});
  tree.primitives.push_back(test::cards_in_ball(60, 0.6, 0.5, 0.4));
  tree.primitives.back().material = 0;
  return tree;
}

TEST(AreaSeries, SaysOfEachEntryWhatAnExtractionSays) {
  const LeafSet leaves = find_leaves(crown_with_a_hollow(), {});
  std::vector<Options> series;
  const auto add = [&](auto&& change) {
    series.push_back(at(Preset::draft));
    change(series.back());
  };
  add([](Options&) {});
  add([](Options& o) { o.point_spacing = 0.25; });
  add([](Options& o) { o.points = PointSource::vertices; });
  add([](Options& o) { o.radius_max = 4; });
  add([](Options& o) { o.band_high = 1; });
  add([](Options& o) { o.band_low = -1; });
  add([](Options& o) { o.flatness = 0.3; });
  add([](Options& o) { o.falloff = 3; });
  add([](Options& o) { o.hollows = Hollows::keep; });
  std::vector<std::array<double, 9>> seen(series.size());
  const auto numbers = [](const Report& r) {
    const auto number = [](std::uint64_t count) { return static_cast<double>(count); };
    return std::array{r.threshold,
                      r.density.p2,
                      r.covered,
                      number(r.counts.leaf_points),
                      number(r.counts.mesh_triangles),
                      number(r.metrics.inside_voxels),
                      number(r.metrics.on_voxels),
                      number(r.metrics.dilated_voxels),
                      number(r.metrics.off_site_sampled)};
  };
  extract_series(leaves, series, device(), [&](std::size_t index, SeriesEntry&& entry) {
    SCOPED_TRACE(index);
    EXPECT_EQ(entry.failure, "");
    seen[index] = numbers(entry.report);
    EXPECT_EQ(seen[index], numbers(extract(leaves, series[index], device()).report));
    return true;
  });
  for (std::size_t i = 1; i < seen.size(); ++i) EXPECT_NE(seen[i], seen[0]) << i;
}

ForestLevel level_of_cards(const Scene& scene, int number, const Options& options,
                           double voxel_size) {
  const std::vector<LeafSet> models{find_leaves(test::card_tree(), {})};
  const std::vector<Options> shapes(models.size(), options);
  const ForestLevel finest = prepare_level(0, scene, models, shapes, voxel_size, nullptr, device());
  return number == 0 ? finest
                     : prepare_level(number, scene, models, shapes, voxel_size, &finest, device());
}

/// The resolved shape options of a canopy.
Options of_a_canopy() {
  ForestOptions forest;
  forest.shape.min_component = 0;  // tiles alone do not show how large a piece over seams is
  return resolved_shape(forest);
}

/// The number of lattice cells whose corners all lie within the triangles.
std::uint64_t cells_inside(const std::vector<Corners>& triangles, double h) {
  const test::Solid solid(triangles, 2 * h);
  Box box;
  for (const auto& corners : triangles) {
    for (const Vec3d& p : corners) box.include(p);
  }
  const auto cell = [h](double v) { return static_cast<int>(std::floor(v / h)); };
  std::set<std::array<int, 3>> samples;
  for (int z = cell(box.low.z); z <= cell(box.high.z) + 1; ++z) {
    for (int y = cell(box.low.y); y <= cell(box.high.y) + 1; ++y) {
      for (int x = cell(box.low.x); x <= cell(box.high.x) + 1; ++x) {
        if (solid.holds(Vec3d(x, y, z) * h)) samples.insert(samples.end(), {z, y, x});
      }
    }
  }
  std::uint64_t count = 0;
  for (const auto& [z, y, x] : samples) {
    bool all = true;
    for (int i = 1; i < 8; ++i)
      all = all && samples.contains({z + (i >> 2), y + (i >> 1 & 1), x + (i & 1)});
    count += all;
  }
  return count;
}

TEST(AreaForest, OfATreeTwiceAsLargeIsTheTreeInVoxels) {
  const LeafSet leaves = find_leaves(test::card_tree(), {});
  Options options = of_a_canopy();
  options.preset.reset(), options.resolution.reset();
  const double h = options.voxel_size.emplace(leaves.crown.longest_side() / 60);
  const Shape alone = extract(leaves, options, device());
  Scene scene;
  scene.models.resize(1);
  scene.trees = {placed(0, {}, 0, 2)};
  options.voxel_size = 2 * h;
  const ForestLevel level = level_of_cards(scene, 0, options, 2 * h);
  EXPECT_NEAR(level.threshold / alone.report.threshold, 1, 1e-4);
  const std::vector<Corners> triangles = canopy(level, 64);
  EXPECT_NEAR(volume(triangles) / std::pow(2 * h, 3) / (volume(alone.mesh) / std::pow(h, 3)), 1,
              0.002);
  EXPECT_NEAR(static_cast<double>(cells_inside(triangles, 2 * h)) /
                  static_cast<double>(alone.report.metrics.inside_voxels),
              1, 0.01);
}

TEST(AreaForest, DoesNotDependOnTheCut) {
  Scene scene;
  scene.models.resize(1);
  scene.trees = {placed(0, {0, 0, 0}, 0, 1), placed(0, {3, 0.5, 1}, 2, 1.4),
                 placed(0, {1, 0, 4}, 4, 0.7)};
  for (const int number : {0, 1}) {
    const ForestLevel level = level_of_cards(scene, number, of_a_canopy(), 0.08);
    using Place = std::array<std::array<double, 3>, 3>;
    const auto places = [&](int edge) {
      std::multiset<Place> all;
      for (const auto& [a, b, c] : canopy(level, edge)) {
        Place p{{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}};
        std::rotate(p.begin(), std::ranges::min_element(p), p.end());
        all.insert(p);
      }
      return all;
    };
    const auto whole = places(512);
    EXPECT_GT(whole.size(), 5000u);
    EXPECT_EQ(places(32), whole);
    EXPECT_EQ(places(96), whole);
  }
}

}  // namespace
}  // namespace leafhull
