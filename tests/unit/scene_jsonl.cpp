// SPDX-License-Identifier: Apache-2.0
#include "scene_files.h"

namespace leafhull {
namespace {

using test::expect_near;
using test::expect_refused;
using test::moved;

class JsonScene : public testing::Test {
 protected:
  void SetUp() override { folder.tree("birch.glb"); }

  Scene read(const std::string& text, const std::string& name = "scene.jsonl") {
    return read_scene(folder.write(name, text), {});
  }
  /// Reads one tree at (1, 2, 3) with these members.
  PlacedTree tree(const std::string& members) {
    return read(R"({"model": "birch.glb", "position": [1, 2, 3])" + members + "}\n").trees.at(0);
  }
  void refuse(const std::string& text, const std::string& message) {
    expect_refused(folder, folder.write("scene.jsonl", text), message);
  }

  test::SceneFolder folder;
};

TEST_F(JsonScene, ReadsEveryFormOfRotationAndScale) {
  EXPECT_EQ(tree("").position, Vec3d(1, 2, 3));
  EXPECT_EQ(tree("").linear, PlacedTree().linear);
  expect_near(moved(tree(R"(, "rotation": 90)"), {1, 0, 0}), {1, 2, 2});
  expect_near(moved(tree(R"(, "rotation": [0, 90, 0])"), {1, 0, 0}), {1, 2, 2});
  expect_near(moved(tree(R"(, "rotation": [90, 90, 0])"), {0, 1, 0}), {2, 2, 3});
  expect_near(moved(tree(R"(, "rotation": [0, 2, 0, 2])"), {1, 0, 0}), {1, 2, 2});
  expect_near(moved(tree(R"(, "scale": 2)"), {1, 0, 0}), {3, 2, 3});
  expect_near(moved(tree(R"(, "scale": [1, -2, 3])"), {1, 1, 1}), {2, 0, 6});
}

TEST_F(JsonScene, ReadsManyLines) {
  const Scene scene = read(
      "\xEF\xBB\xBF{\"position\":[0,0,1],\"model\":\"birch.glb\"}\r\n\n# none\n"
      "{\"model\":\"birch.glb\",\"position\":[0,0,2],\"age\":3,\"scale\":2}\n"
      "{\"model\":\"birch.glb\",\"position\":[0,0,3]}",
      "scene.NDJSON");
  ASSERT_EQ(scene.trees.size(), 3u);
  EXPECT_EQ(scene.models.size(), 1u);
  EXPECT_EQ(scene.trees[2].position, Vec3d(0, 0, 3));
  EXPECT_EQ(scene.trees[2].linear, PlacedTree().linear) << "nothing is left from the line before";
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_TRUE(scene.warnings[0].ends_with("scene.NDJSON: passed over: \"age\""));
}

TEST_F(JsonScene, SkipsAndCountsWhatCannotStand) {
  const Scene scene = read(R"({"model": "birch.glb", "position": [0, 0, 0]}
{"model": "birch.glb", "position": [0, 0, null]}
{"model": "birch.glb", "position": [0, 0, 0], "scale": NaN}
{"model": "birch.glb", "position": [0, 0, -Infinity]}
{"model": "birch.glb", "position": [0, 0, 0], "rotation": [0, 0, 0, 0]}
{"model": "birch.glb", "position": [0, 0, 0], "rotation": null}
{"model": "birch.glb", "position": [0, 0, 0], "scale": [1, 0, 1]}
)");
  EXPECT_EQ(scene.trees.size(), 1u);
  EXPECT_EQ(scene.skipped, 6u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("6 trees were skipped, the first at line 2"), std::string::npos);
}

TEST_F(JsonScene, NamesOfNumbersAreTextWithinQuotes) {
  folder.tree("-Infinity \"NaN.glb");
  const Scene scene =
      read(R"({"model": "-Infinity \"NaN.glb", "position": [0, 0, 0], "age": NaN})");
  EXPECT_EQ(scene.models.at(0).name, "-Infinity \"NaN");
}

TEST_F(JsonScene, BadLinesAreNamed) {
  const std::string good = "{\"model\": \"birch.glb\", \"position\": [0, 0, 0]}\n";
  const auto refuse_line = [&](const std::string& line, const std::string& what) {
    refuse(good + line + '\n', "scene.jsonl, line 2: " + what);
  };
  refuse("", "scene.jsonl holds no trees");
  refuse_line("{\"model\": \"birch.glb\",", "is not a JSON object");
  refuse_line("[1, 2]", "is not a JSON object");
  refuse_line("model,x,y,z", "is not a JSON object");
  refuse_line("{\"model\": \"birch.glb\", \"position\": [0, 0, 1e999]}", "is not a JSON object");
  refuse_line("{\"position\": [0, 0, 0]}", "has no model");
  refuse_line("{\"model\": \"birch.glb\"}", "has no position");
  refuse_line("{\"model\": 3, \"position\": [0, 0, 0]}", "its model is not text");
  refuse_line("{\"model\": \"birch.glb\", \"position\": [0, 0]}",
              "its position is not three numbers");
  refuse_line("{\"model\": \"birch.glb\", \"position\": [0, 0, \"1\"]}",
              "its position is not three numbers");
  refuse_line("{\"model\": \"birch.glb\", \"position\": [0, 0, 0], \"rotation\": [1, 2]}",
              "its rotation is not one, three or four numbers");
  refuse_line("{\"model\": \"birch.glb\", \"position\": [0, 0, 0], \"scale\": \"2\"}",
              "its scale is not one or three numbers");
  refuse_line("{\"model\": \"oak.glb\", \"position\": [0, 0, 0]}",
              "the tree file oak.glb is not there: No such file or directory");
}

}  // namespace
}  // namespace leafhull
