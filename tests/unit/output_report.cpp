// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "leafhull/output.h"
#include "leafhull/version.h"
#include "output_sample.h"

namespace leafhull::test {
namespace {

using Json = nlohmann::ordered_json;

Json report_of(const Shape& shape, const RunDescription& run = {}) {
  return Json::parse(report_json(shape.report, run));
}

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

TEST(Report, HasTheKeysOfTheSpecification) {
  const Json report = report_of(sample_shape());
  EXPECT_EQ(keys(report),
            (std::vector<std::string>{"schema", "version", "input", "command", "parameters",
                                      "device", "counts", "density", "metrics", "seconds",
                                      "peak_memory_bytes", "warnings"}));
  for (const char* key :
       {"style", "method", "threshold", "threshold_percent", "coverage", "radius_max",
        "radius_unit", "radius_max_model", "flatness", "falloff", "spread", "density", "band_low",
        "band_high", "leaf_scale", "min_component", "hollows", "resolution", "voxel_size"}) {
    EXPECT_TRUE(report["parameters"].contains(key)) << key;
  }
}

TEST(Report, SaysWhatWasRun) {
  const Json report = report_of(sample_shape(), {"tree.glb", {"leafhull", "extract", "tree.glb"}});
  EXPECT_EQ(report["schema"], "leafhull-report/1");
  EXPECT_EQ(report["version"], kVersion);
  EXPECT_EQ(report["input"], "tree.glb");
  EXPECT_EQ(report["command"], (Json{"leafhull", "extract", "tree.glb"}));
  EXPECT_EQ(report["device"], "a device");
  EXPECT_EQ(report["peak_memory_bytes"], 1 << 20);
  EXPECT_EQ(report["warnings"], Json{"one thing"});
}

TEST(Report, ResolvesEveryParameter) {
  Shape shape = sample_shape();
  Options asked;
  asked.radius_max = 2.5;
  asked.coverage = 0.8;
  asked.spread = Spread::variance;
  asked.leaves = {"*leaf*"};
  asked.ellipse = TextureEllipse{{0.5, 0.25}, {0.1, 0}, {0, 0.2}};
  shape.report.options = resolve(asked);
  const Json parameters = report_of(shape)["parameters"];
  for (const OptionRow& row : option_table()) {
    std::string key(row.name);
    std::replace(key.begin(), key.end(), '-', '_');
    EXPECT_TRUE(parameters.contains(key)) << key;
  }
  EXPECT_EQ(parameters["style"], "painterly");
  EXPECT_EQ(parameters["method"], "controlled");
  EXPECT_EQ(parameters["spread"], "variance");
  EXPECT_EQ(parameters["coverage"], 0.8);
  EXPECT_TRUE(parameters["threshold_percent"].is_null());
  EXPECT_EQ(parameters["threshold"], 1.7);
  EXPECT_EQ(parameters["radius_max"], 2.5);
  EXPECT_EQ(parameters["radius_max_model"], 0.3);
  EXPECT_EQ(parameters["resolution"], 128);
  EXPECT_EQ(parameters["voxel_size"], 0.1);
  EXPECT_EQ(parameters["snap"], true);
  EXPECT_EQ(parameters["leaves"], Json{"*leaf*"});
  EXPECT_EQ(parameters["ellipse"], (Json{0.5, 0.25, 0.1, 0.0, 0.0, 0.2}));
}

TEST(Report, CopiesEveryFigure) {
  Shape shape = sample_shape();
  shape.report.leaf_colour = Vec3f{0.068478f, 0.194618f, 0.025187f};
  const Json report = report_of(shape);
  EXPECT_EQ(
      report["counts"].dump(),
      R"({"leaves":1,"leaf_vertices":2,"leaf_points":16,"leaf_area":17.5,"leaf_colour":"#4a7a2c",)"
      R"("dropped_leaves":3,"split_components":4,)"
      R"("evaluated_voxels":5000000000,"evaluated_pairs":6,"mesh_vertices":7,)"
      R"("mesh_triangles":8,"components":9,"dropped_components":10})");
  EXPECT_EQ(report["density"].dump(),
            R"({"mean":0.1,"variance":0.25,"deviation":0.5,"p1":0.3,"p2":0.4})");
  EXPECT_EQ(report["metrics"].dump(),
            R"({"dilated_voxels":11,"inside_voxels":12,"on_voxels":13,)"
            R"("off_site_exact":14,"off_site_sampled":15,"covered":0.875,)"
            R"("erosion":0.0625,"dilation":0.625})");
  EXPECT_EQ(report["seconds"].dump(), R"({"hash":2.0,"snap_vertices":0.25,"total":2.25})");
}

TEST(Report, WritesNumbersAsAPersonDoes) {
  const std::string text = report_json(sample_shape().report, {});
  EXPECT_NE(text.find("\n    \"threshold\": 1.7,"), std::string::npos) << text;
  EXPECT_NE(text.find("\"radius_max\": 3.5,"), std::string::npos) << text;
  EXPECT_EQ(text.back(), '\n');
}

TEST(Report, StaysJsonWithAnyFileName) {
  const Json report = report_of(sample_shape(), {"tr\xff \"1\".glb", {}});
  EXPECT_EQ(report["input"], "tr\xef\xbf\xbd \"1\".glb");
}

}  // namespace
}  // namespace leafhull::test
