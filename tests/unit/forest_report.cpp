// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "leafhull/error.h"
#include "leafhull/forest.h"

namespace leafhull {
namespace {

using AnyJson = nlohmann::json;

AnyJson report_of(const ForestSummary& summary, const ForestOptions& options = {}) {
  return AnyJson::parse(
      forest_report_json(summary, options, {"stand.csv", {"leafhull", "forest"}}));
}

TEST(ForestReport, SaysWhatTheRunDid) {
  ForestSummary summary;
  summary.trees = 2000;
  summary.models = 30;
  summary.skipped = 2;
  summary.tiles = 12;
  summary.resumed = 5;
  summary.empty = 1;
  summary.remaining = 3;
  summary.leaf_vertices = 1'500'000'000;
  summary.mesh_vertices = 10;
  summary.mesh_triangles = 20;
  summary.peak_memory_bytes = std::uint64_t{3} << 30;
  summary.seconds = {{"models", 1}, {"tiles", 2}, {"tiles", 0.5}, {"total", 4}};
  summary.warnings = {"a tree has a scale of 0"};

  const AnyJson report = report_of(summary);
  EXPECT_EQ(report["schema"], "leafhull-forest-report/1");
  EXPECT_EQ(report["input"], "stand.csv");
  EXPECT_EQ(report["command"], AnyJson({"leafhull", "forest"}));
  EXPECT_EQ(report["scene"], AnyJson({{"trees", 2000}, {"models", 30}, {"skipped", 2}}));
  EXPECT_EQ(report["counts"], AnyJson({{"leaf_vertices", 1'500'000'000},
                                       {"tiles", 12},
                                       {"empty", 1},
                                       {"mesh_vertices", 10},
                                       {"mesh_triangles", 20}}));
  EXPECT_EQ(report["resumed"], 5);
  EXPECT_EQ(report["remaining"], 3);
  EXPECT_EQ(report["seconds"], AnyJson({{"models", 1.0}, {"tiles", 2.5}, {"total", 4.0}}));
  EXPECT_EQ(report["peak_memory_bytes"], std::uint64_t{3} << 30);
  EXPECT_EQ(report["warnings"], AnyJson({"a tree has a scale of 0"}));
  EXPECT_EQ(report["tiles"], AnyJson::array());
}

TEST(ForestReport, HasARowForEachTile) {
  ForestSummary summary;
  summary.rows = {{.level = 1,
                   .x = -2,
                   .y = 3,
                   .z = 4,
                   .leaf_vertices = 5,
                   .gathered = 6,
                   .evaluated_voxels = 7,
                   .vertices = 8,
                   .triangles = 9,
                   .seconds = 0.5,
                   .resident_bytes = 10,
                   .rank = 11},
                  {.level = 2}};
  const AnyJson tiles = report_of(summary)["tiles"];
  ASSERT_EQ(tiles.size(), 2U);
  EXPECT_EQ(tiles[0], AnyJson({{"level", 1},
                               {"x", -2},
                               {"y", 3},
                               {"z", 4},
                               {"leaf_points", 5},
                               {"gathered", 6},
                               {"evaluated_voxels", 7},
                               {"vertices", 8},
                               {"triangles", 9},
                               {"seconds", 0.5},
                               {"resident_bytes", 10},
                               {"rank", 11}}));
  EXPECT_EQ(tiles[1]["level"], 2);
}

TEST(ForestReport, SaysWithWhichOptions) {
  ForestOptions options;
  options.shape.style = Style::paper_thin;
  options.shape.voxel_size = 0.25;
  const AnyJson plain = report_of({}, options)["options"];
  EXPECT_EQ(plain["style"], "paper-thin");
  EXPECT_EQ(plain["threshold"], 2.0) << "what the style sets is said too";
  EXPECT_EQ(plain["voxel_size"], 0.25);
  EXPECT_EQ(plain["merge"], "canopy");
  EXPECT_EQ(plain["control_scope"], "model");
  EXPECT_EQ(plain["memory_bytes"], std::uint64_t{4} << 30);
  EXPECT_TRUE(plain["tile"].is_null());
  EXPECT_TRUE(plain["tile_range"].is_null());
  EXPECT_TRUE(plain["single"].is_null());
  EXPECT_FALSE(plain.contains("mesher"));
  EXPECT_FALSE(plain.contains("adaptivity"));

  options.tile = 64;
  options.range = TileRange{2, 4};
  options.single = "stand.ply";
  options.levels = 3;
  const AnyJson set = report_of({}, options)["options"];
  EXPECT_EQ(set["tile"], 64);
  EXPECT_EQ(set["tile_range"], AnyJson({2, 4}));
  EXPECT_EQ(set["single"], "stand.ply");
  EXPECT_EQ(set["levels"], 3);
}

TEST(ForestReport, NamesThatAreNoUtf8DoNotBreakIt) {
  const std::string text = forest_report_json({}, {}, {"st\xff.csv", {}});
  EXPECT_TRUE(AnyJson::accept(text)) << text;
}

}  // namespace
}  // namespace leafhull
