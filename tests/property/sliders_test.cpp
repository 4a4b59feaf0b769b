// SPDX-License-Identifier: Apache-2.0
// A shape has the erosion and the dilation that were asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "leafhull/error.h"
#include "leafhull/series.h"
#include "leafhull/shape.h"
#include "points/samples.h"
#include "property/area_measures.h"
#include "property/area_trees.h"
#include "property/canopies.h"
#include "property/extractions.h"
#include "tiles/compute_tile.h"
#include "tiles/tile_plan.h"

namespace leafhull {
namespace {

using test::ash;
using test::canopy;
using test::device;
using test::expect_same;
using test::placed;
using test::share_outside;

constexpr double kError = 0.01;

const LeafSet& more_cards() {
  static const LeafSet leaves = find_leaves(test::card_tree(300), {});
  return leaves;
}

const LeafSet& cards() {
  static const LeafSet leaves = find_leaves(test::card_tree(), {});
  return leaves;
}

Options asked(std::optional<double> erosion, std::optional<double> dilation,
              Preset preset = Preset::draft) {
  Options options;
  options.erosion = erosion;
  options.dilation = dilation;
  options.preset = preset;
  return options;
}

void expect_kept(const Report& report, const Options& options) {
  const Metrics& found = report.metrics;
  EXPECT_NEAR(found.erosion, options.erosion.value_or(found.erosion), kError);
  EXPECT_NEAR(found.dilation, options.dilation.value_or(found.dilation), kError);
}

struct SliderTree {
  const char* name;
  const LeafSet& (*leaves)();
  std::vector<std::pair<double, double>> reachable;  ///< erosion and dilation
  std::vector<double> dilations;                     ///< reachable with any erosion in [0.05, 0.2]
};
const SliderTree kSliderTrees[] = {
    {"ash",
     ash,
     {{0.05, 0.25}, {0.05, 0.4}, {0.1, 0.55}, {0.2, 0.3}, {0.2, 0.5}, {0.4, 0.3}},
     {0.3, 0.45}},
    {"cards",
     cards,
     {{0.05, 0.55}, {0.05, 0.7}, {0.1, 0.55}, {0.2, 0.55}, {0.3, 0.5}},
     {0.55, 0.65}}};

class Sliders : public testing::TestWithParam<SliderTree> {};
INSTANTIATE_TEST_SUITE_P(Trees, Sliders, testing::ValuesIn(kSliderTrees),
                         [](const auto& kind) { return std::string(kind.param.name); });

TEST_P(Sliders, AreKept) {
  for (const Preset preset : {Preset::draft, Preset::standard}) {
    for (const auto& [erosion, dilation] : GetParam().reachable) {
      SCOPED_TRACE(testing::Message() << name(preset) << ' ' << erosion << ' ' << dilation);
      const Options options = asked(erosion, dilation, preset);
      const Report report = extract(GetParam().leaves(), options, device()).report;
      expect_kept(report, options);
      EXPECT_EQ(report.options.erosion, erosion);
      EXPECT_EQ(report.options.dilation, dilation);
      EXPECT_TRUE(report.options.radius_max) << "it says what was found";
      EXPECT_EQ(report.options.radius_unit, RadiusUnit::crown);
    }
  }
}

TEST_P(Sliders, OneAloneIsKept) {
  const LeafSet& leaves = GetParam().leaves();
  for (const double erosion : {0.03, 0.15, 0.35}) {
    SCOPED_TRACE(erosion);
    const Report report = extract(leaves, asked(erosion, {}), device()).report;
    EXPECT_NEAR(report.metrics.erosion, erosion, kError);
    EXPECT_EQ(report.options.radius_max, 3.5) << "the style's";
  }
  for (const double dilation : {0.4, 0.5}) {
    SCOPED_TRACE(dilation);
    Options options = asked({}, dilation);
    options.coverage = 0.9;
    const Report report = extract(leaves, options, device()).report;
    EXPECT_NEAR(report.metrics.dilation, dilation, kError);
    EXPECT_NEAR(report.covered, 0.9, 0.005);
  }
}

TEST_P(Sliders, ADilationIsThatOf64Voxels) {
  const LeafSet& leaves = GetParam().leaves();
  for (const auto& [erosion, dilation] : GetParam().reachable) {
    const Report found =
        extract(leaves, asked(erosion, dilation, Preset::standard), device()).report;
    Options options;
    options.preset = Preset::paper_64;
    options.radius_max = found.options.radius_max;
    options.threshold = found.threshold;
    const Report report = extract(leaves, options, device()).report;
    const Metrics& m = report.metrics;
    EXPECT_EQ(
        static_cast<double>(m.dilated_voxels) / static_cast<double>(m.inside_voxels + m.on_voxels),
        found.metrics.dilation);
    EXPECT_EQ(m.dilation, found.metrics.dilation);
    EXPECT_EQ(report.radius_max_model, found.radius_max_model);
  }
}

TEST(SlidersOfCards, AnErosionIsThatOfTheMesh) {
  const std::vector<Vec3d> places = test::places_on(test::card_tree(), 10000);
  for (const auto& [erosion, dilation] : kSliderTrees[1].reachable) {
    SCOPED_TRACE(testing::Message() << erosion << ' ' << dilation);
    const Shape shape = extract(cards(), asked(erosion, dilation, Preset::standard), device());
    EXPECT_NEAR(share_outside(places, shape), erosion, 0.02);
    EXPECT_NEAR(share_outside(places, shape), shape.report.metrics.erosion, 0.02);
  }
}

TEST(SlidersOfAnAsh, AnErosionIsThatOfTheMesh) {
  const std::vector<Vec3d> places = samples_of(*ash().sheets, ash().crown).places;
  for (const auto& [erosion, dilation] : kSliderTrees[0].reachable) {
    SCOPED_TRACE(testing::Message() << erosion << ' ' << dilation);
    const Shape shape = extract(ash(), asked(erosion, dilation, Preset::standard), device());
    EXPECT_NEAR(share_outside(places, shape), erosion, 0.02);
    EXPECT_NEAR(share_outside(places, shape), shape.report.metrics.erosion, 0.01);
  }
}

TEST(SlidersOfCards, PiecesThatAreDroppedAreEroded) {
  const std::vector<Vec3d> places = test::places_on(test::card_tree(), 10000);
  for (const double least : {0.0, 0.05}) {
    SCOPED_TRACE(least);
    Options options = asked(0.3, {}, Preset::standard);
    options.radius_max = 4;
    options.min_component = least;
    const Shape shape = extract(cards(), options, device());
    EXPECT_EQ(shape.report.counts.dropped_components > 0, least > 0);
    EXPECT_NEAR(shape.report.metrics.erosion, 0.3, kError);
    EXPECT_NEAR(share_outside(places, shape), 0.3, 0.02);
    if (least > 0) {
      EXPECT_GT(shape.report.covered, 0.75) << "T takes in more than is kept";
    }
  }
}

TEST_P(Sliders, TheReportsErosionIsThatOfAnyShape) {
  for (const double coverage : {0.6, 0.9}) {
    Options options;
    options.preset = Preset::standard;
    options.coverage = coverage;
    options.min_component = 0;
    const Metrics m = extract(GetParam().leaves(), options, device()).report.metrics;
    EXPECT_NEAR(m.erosion, 1 - coverage, 2 * kError) << "what the lattice shows";
    constexpr double kSamples = 1 << 15;
    EXPECT_EQ(m.erosion, static_cast<double>(m.off_site_sampled) / kSamples);
  }
}

TEST_P(Sliders, AnErosionLeavesTheDilation) {
  for (const double dilation : GetParam().dilations) {
    const auto of = [&](double erosion) {
      return extract(GetParam().leaves(), asked(erosion, dilation), device()).report;
    };
    const Report little = of(0.05), much = of(0.2);
    EXPECT_NEAR(little.metrics.dilation, dilation, kError);
    EXPECT_NEAR(much.metrics.dilation, dilation, kError);
    EXPECT_GT(much.metrics.erosion, little.metrics.erosion + 0.13);
    EXPECT_GT(*much.options.radius_max, *little.options.radius_max);
  }
}

TEST_P(Sliders, AFinerLatticeIsTheSameShape) {
  const LeafSet& leaves = GetParam().leaves();
  const auto [erosion, dilation] = GetParam().reachable[1];
  const Report draft = extract(leaves, asked(erosion, dilation), device()).report;
  for (const Preset preset : {Preset::standard, Preset::fine}) {
    const Options options = asked(erosion, dilation, preset);
    const Report fine = extract(leaves, options, device()).report;
    expect_kept(fine, options);
    EXPECT_NEAR(*fine.options.radius_max / *draft.options.radius_max, 1, 0.05);
    EXPECT_NEAR(fine.threshold / draft.threshold, 1, 0.05);
  }
}

void expect_same_with_sliders(const Shape& a, const Shape& b) {
  expect_same(a, b);
  EXPECT_EQ(a.report.threshold, b.report.threshold);
  EXPECT_EQ(a.report.options.radius_max, b.report.options.radius_max);
  EXPECT_EQ(a.report.metrics.erosion, b.report.metrics.erosion);
  EXPECT_EQ(a.report.metrics.dilation, b.report.metrics.dilation);
}

TEST_P(Sliders, AreTheSameBytesDenseOnAnyThreadsAndAgain) {
  Device one({.choice = "", .threads = 1, .variant = ""});
  const LeafSet& leaves = GetParam().leaves();
  for (const auto& [erosion, dilation] : GetParam().reachable) {
    SCOPED_TRACE(testing::Message() << erosion << ' ' << dilation);
    Options options = asked(erosion, dilation);
    const Shape shape = extract(leaves, options, device());
    EXPECT_FALSE(shape.mesh.triangles.empty());
    expect_same_with_sliders(extract(leaves, options, device()), shape);
    expect_same_with_sliders(extract(leaves, options, one), shape);
    options.dense = true;
    expect_same_with_sliders(extract(leaves, options, device()), shape);
  }
}

TEST_P(Sliders, WhatIsFoundGivesTheShapeAgain) {
  const LeafSet& leaves = GetParam().leaves();
  for (const auto& [erosion, dilation] : GetParam().reachable) {
    const Shape found = extract(leaves, asked(erosion, dilation), device());
    Options options;
    options.preset = Preset::draft;
    options.radius_max = found.report.options.radius_max;
    options.threshold = found.report.threshold;
    expect_same_with_sliders(extract(leaves, options, device()), found);
  }
}

TEST_P(Sliders, ASeriesSaysWhatAnExtractionSays) {
  const LeafSet& leaves = GetParam().leaves();
  std::vector<Options> series;
  for (const auto& [erosion, dilation] : GetParam().reachable) {
    series.push_back(asked(erosion, dilation));
    series.push_back(asked(erosion, {}));
    series.push_back(asked({}, dilation));
    series.back().coverage = 0.9;
    series.emplace_back().preset = Preset::draft;
  }
  series.push_back(asked(0.1, 0.97));
  std::size_t failures = 0;
  extract_series(leaves, series, device(), [&](std::size_t index, SeriesEntry&& entry) {
    SCOPED_TRACE(index);
    if (index + 1 == series.size()) {
      EXPECT_NE(entry.failure.find("a dilation of 0.97 cannot be reached"), std::string::npos);
      ++failures;
      return true;
    }
    EXPECT_EQ(entry.failure, "");
    const Report a = entry.report, b = extract(leaves, series[index], device()).report;
    EXPECT_EQ(a.threshold, b.threshold);
    EXPECT_EQ(a.radius_max_model, b.radius_max_model);
    EXPECT_EQ(a.covered, b.covered);
    EXPECT_EQ(a.metrics.erosion, b.metrics.erosion);
    EXPECT_EQ(a.metrics.dilation, b.metrics.dilation);
    EXPECT_EQ(a.metrics.inside_voxels, b.metrics.inside_voxels);
    EXPECT_EQ(a.metrics.dilated_voxels, b.metrics.dilated_voxels);
    EXPECT_EQ(a.counts.components, b.counts.components);
    EXPECT_EQ(a.counts.dropped_components, b.counts.dropped_components);
    EXPECT_EQ(a.counts.mesh_triangles, b.counts.mesh_triangles);
    return true;
  });
  EXPECT_EQ(failures, 1u);
}

TEST(SlidersOfAnAsh, WorkAtVertices) {
  for (const auto& [erosion, dilation] : {std::pair(0.05, 0.65), {0.2, 0.5}, {0.2, 0.6}}) {
    for (const Style style : {Style::painterly, Style::paper_thin}) {
      SCOPED_TRACE(testing::Message() << name(style) << ' ' << erosion << ' ' << dilation);
      Options options = asked(erosion, dilation);
      options.style = style;
      options.points = PointSource::vertices;
      expect_kept(extract(ash(), options, device()).report, options);
    }
  }
}

/// Expects the extraction to fail with a usage error; returns the error with its remedy.
std::string refusal(const LeafSet& leaves, const Options& options) {
  try {
    extract(leaves, options, device());
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_FALSE(error.remedy().empty());
    return error.what();
  }
  ADD_FAILURE() << "went through";
  return {};
}

bool has(const std::string& text, std::string_view words) {
  return text.find(words) != std::string::npos;
}

/// The number that a refusal offers instead.
double offered(const std::string& refusal) {
  const std::string words = " to 0.";  // "it goes down to 0.31, with ..."
  const std::size_t at = refusal.find(words);
  EXPECT_NE(at, std::string::npos) << refusal;
  return at == std::string::npos ? 0 : std::stod(refusal.substr(at + 4));
}

TEST_P(Sliders, ADilationThatCannotBeHadSaysWhatCan) {
  const std::string said = refusal(GetParam().leaves(), asked(0.1, 0.97));
  EXPECT_PRED2(has, said, "a dilation of 0.97 cannot be reached");
  EXPECT_GT(offered(said), 0.3);
  EXPECT_LT(offered(said), 0.97);
}

TEST(SlidersOfAnAsh, ADilationThatIsOfferedCanBeHad) {
  for (const double dilation : {0.02, 0.97}) {
    SCOPED_TRACE(dilation);
    const Options options = asked(0.1, offered(refusal(ash(), asked(0.1, dilation))));
    expect_kept(extract(ash(), options, device()).report, options);
  }
}

TEST(SlidersOfACard, AnErosionOfASheetOfOneDensityIsRefused) {
  const LeafSet card = find_leaves(test::tree_of({test::card(10, 10)}), {});
  const std::string said = refusal(card, asked(0.3, {}));
  EXPECT_PRED2(has, said, "sheets of one density") << said;
  EXPECT_PRED2(has, said, "an erosion of 0.3 cannot be reached") << said;
  Options options = asked(0.3, {});
  options.erosion.reset();
  options.coverage = 0.98;
  EXPECT_NO_THROW(extract(card, options, device()));
}

/// A forest with one tree of each of two kinds.
struct Forest {
  Scene scene;
  std::vector<LeafSet> models;
  std::vector<Options> shapes;
  ForestLevel level;
};

Forest forest_of(const Options& options) {
  Forest forest;
  forest.scene.models.resize(2);
  forest.scene.trees = {placed(0, {}, 0, 1), placed(1, {20, 0, 0}, 0, 1)};
  forest.models = {cards(), more_cards()};
  const std::vector<ModelUse> uses = model_uses(forest.scene);
  forest.shapes = shapes_of(forest.models, uses, options, device());
  forest.level = prepare_level(0, forest.scene, forest.models, forest.shapes, *options.voxel_size,
                               nullptr, device());
  return forest;
}

/// The triangles of a forest near its first tree, or near the other.
std::vector<test::Corners> canopy_of(const Forest& forest, bool other) {
  std::vector<test::Corners> all;
  for (const auto& corners : canopy(forest.level, 128)) {
    if ((corners[0].x > 10) == other) all.push_back(corners);
  }
  return all;
}

TEST(SlidersOfAForest, AreThoseOfEachOfItsTrees) {
  ForestOptions asked_for;
  asked_for.shape = asked(0.1, 0.6);
  asked_for.shape.preset.reset();
  asked_for.shape.min_component = 0;  // tiles alone do not show how large a piece over seams is
  asked_for.shape.voxel_size = cards().crown.longest_side() / 100;
  const Options options = resolved_shape(asked_for);
  const Forest forest = forest_of(options);
  EXPECT_EQ(forest.level.threshold, 1) << "each model has its own";
  EXPECT_NE(forest.shapes[0].radius_max, forest.shapes[1].radius_max);
  for (const bool other : {false, true}) {
    SCOPED_TRACE(other ? "more cards" : "cards");
    const LeafSet& leaves = other ? more_cards() : cards();
    const Shape alone = extract(leaves, options, device());
    expect_kept(alone.report, options);
    // For a single tree, T is corrected for what the lattice misses.
    EXPECT_NEAR(*forest.shapes[other].radius_max / *alone.report.options.radius_max, 1, 0.05);
    EXPECT_GT(test::volume(alone.mesh), 5);
    EXPECT_NEAR(test::volume(canopy_of(forest, other)) / test::volume(alone.mesh), 1, 0.05);
  }
}

}  // namespace
}  // namespace leafhull
