// SPDX-License-Identifier: Apache-2.0
#include "scene_files.h"

namespace leafhull {
namespace {

using test::expect_near;
using test::expect_refused;
using test::moved;

class CsvScene : public testing::Test {
 protected:
  void SetUp() override {
    folder.tree("birch.glb");
    folder.tree("ash.glb");
  }

  Scene read(const std::string& text, const std::string& name = "scene.csv") {
    return read_scene(folder.write(name, text), {});
  }
  void refuse(const std::string& text, const std::string& message) {
    expect_refused(folder, folder.write("scene.csv", text), message);
  }

  test::SceneFolder folder;
};

TEST_F(CsvScene, NamesModelsAndPlaces) {
  const Scene scene = read("model,x,y,z\nbirch.glb,1,2,3\nash.glb,-4.5,0,1e3\nbirch.glb,7,8,9\n");
  ASSERT_EQ(scene.models.size(), 2u);
  EXPECT_EQ(scene.models[0].name, "birch");
  EXPECT_EQ(scene.models[1].name, "ash");
  EXPECT_EQ(scene.models[1].file, folder / "ash.glb");
  EXPECT_EQ(scene.models[0].meshes, nullptr);
  ASSERT_EQ(scene.trees.size(), 3u);
  EXPECT_EQ(scene.trees[1].position, Vec3d(-4.5, 0, 1000));
  EXPECT_EQ(scene.trees[1].linear, PlacedTree().linear);
  EXPECT_EQ(scene.trees[0].model, 0u);
  EXPECT_EQ(scene.trees[1].model, 1u);
  EXPECT_EQ(scene.trees[2].model, 0u);
  EXPECT_EQ(scene.skipped, 0u);
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_EQ(read_model(scene.models[0], {}).leaf_count, 8u);
}

TEST_F(CsvScene, ColumnsComeInAnyOrderAndCase) {
  const Scene scene = read("SCALE,Position_Z,position_x,Model,POSITION_Y\n2,3,1,birch.glb,2\n");
  EXPECT_EQ(scene.trees[0].position, Vec3d(1, 2, 3));
  EXPECT_EQ(scene.trees[0].linear, (std::array<float, 9>{2, 0, 0, 0, 2, 0, 0, 0, 2}));
}

TEST_F(CsvScene, YawTurnsAboutY) {
  const Scene scene = read("model,x,y,z,yaw,scale\nbirch.glb,10,0,0,90,2\n");
  expect_near(moved(scene.trees[0], {1, 0, 0}), {10, 0, -2});
  expect_near(moved(scene.trees[0], {0, 1, 0}), {10, 2, 0});
  expect_near(moved(scene.trees[0], {0, 0, 1}), {12, 0, 0});
}

TEST_F(CsvScene, AnglesTurnAboutXThenYThenZ) {
  const Scene scene = read(
      "model,x,y,z,rx,ry,rz\nbirch.glb,0,0,0,90,0,0\nbirch.glb,0,0,0,90,90,0\n"
      "birch.glb,0,0,0,90,90,90\n");
  // rx takes y to z, ry takes z to x, and rz takes x to y.
  expect_near(moved(scene.trees[0], {0, 1, 0}), {0, 0, 1});
  expect_near(moved(scene.trees[1], {0, 1, 0}), {1, 0, 0});
  expect_near(moved(scene.trees[2], {0, 1, 0}), {0, 1, 0});
}

TEST_F(CsvScene, QuaternionsNeedNotBeOfUnitLength) {
  const Scene scene = read(
      "model,x,y,z,qx,qy,qz,qw,sx,sy,sz\nbirch.glb,0,0,0,0,0,3,3,1,2,4\n"
      "birch.glb,0,0,0,0,0,3e200,3e200,1,2,4\n");
  for (const PlacedTree& tree : scene.trees) {
    expect_near(moved(tree, {1, 0, 0}), {0, 1, 0});
    expect_near(moved(tree, {0, 1, 0}), {-2, 0, 0});
    expect_near(moved(tree, {0, 0, 1}), {0, 0, 4});
  }
}

TEST_F(CsvScene, WithoutNamesTheCountTells) {
  const Scene four = read("birch.glb,1,2,3\nash.glb,4,5,6\n");
  EXPECT_EQ(four.trees.size(), 2u);
  EXPECT_EQ(four.trees[0].position, Vec3d(1, 2, 3));
  expect_near(moved(read("birch.glb,1,2,3,0,1,0,1\n").trees[0], {1, 0, 0}), {1, 2, 2});
  expect_near(moved(read("birch.glb,1,2,3,0,1,0,1,2\n").trees[0], {1, 0, 0}), {1, 2, 1});
  expect_near(moved(read("birch.glb,1,2,3,0,1,0,1,2,3,4\n").trees[0], {0, 1, 0}), {1, 5, 3});
  refuse("birch.glb,1,2,3,4\n", "scene.csv, line 1: has 5 fields, not 4, 8, 9 or 11");
}

TEST_F(CsvScene, TextIsTakenAsProgramsWriteIt) {
  folder.tree("a, \"b\".glb");
  const Scene scene = read(
      "\xEF\xBB\xBF# made by hand\r\n\r\nmodel, x ,y,z,\"scale\"\r\n  # a, \"comment\r\n"
      "\"a, \"\"b\"\".glb\" , +1 ,2,\"3\",1\r\n   \t\r\nbirch.glb,4,5,6,1");
  ASSERT_EQ(scene.trees.size(), 2u);
  EXPECT_EQ(scene.models[0].name, "a, \"b\"");
  EXPECT_EQ(scene.trees[0].position, Vec3d(1, 2, 3));
  EXPECT_EQ(scene.trees[1].position, Vec3d(4, 5, 6));
}

TEST_F(CsvScene, SemicolonsAndTabsSeparateToo) {
  folder.tree("a; b, c.glb");
  for (const std::string separator : {";", "\t"}) {
    for (const std::string head : {"model,x,y,z,species\n", ""}) {
      std::string text = head + "birch.glb, 1 ,2,3" + (head.empty() ? "" : ",") + "\n";
      for (std::size_t at = 0; (at = text.find(',', at)) != std::string::npos;) {
        text.replace(at, 1, separator);
      }
      text += "\"a; b, c.glb\"" + separator + "4" + separator + "5" + separator + "6" +
              (head.empty() ? "" : separator + "x") + "\n";
      const Scene scene = read("\xEF\xBB\xBF" + text);
      ASSERT_EQ(scene.trees.size(), 2u);
      EXPECT_EQ(scene.trees[0].position, Vec3d(1, 2, 3));
      EXPECT_EQ(scene.models[1].name, "a; b, c");
    }
  }
  EXPECT_EQ(read("model,\tx,\ty,\tz\nbirch.glb,\t1,2,3\n").trees.size(), 1u);
  EXPECT_EQ(read("\"a; b, c.glb\",1,2,3\n").trees.size(), 1u);
}

TEST_F(CsvScene, DecimalCommasAreNamed) {
  refuse("model;x;y;z\nbirch.glb;1;2,5;3\n",
         "scene.csv, line 2: \"2,5\" in column y has a decimal comma");
  refuse("birch.glb;1,5;2,5;3,5\n", "scene.csv, line 1: \"1,5\" in column x has a decimal comma");
  refuse("model,x,y,z\nbirch.glb,1,\"2,5\",3\n",
         "scene.csv, line 2: \"2,5\" in column y has a decimal comma");
  refuse("model;x;y;z\nbirch.glb;1;2,5m;3\n",
         "scene.csv, line 2: \"2,5m\" in column y is not a number");
}

TEST_F(CsvScene, UnknownColumnsArePassedOverWithOneWarning) {
  const Scene scene = read("age,model,x,y,z,species\nold,birch.glb,1,2,3,x\nnew,ash.glb,1,2,3,y\n");
  EXPECT_EQ(scene.trees.size(), 2u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_TRUE(scene.warnings[0].ends_with("scene.csv: passed over: \"age\", \"species\""))
      << scene.warnings[0];
}

TEST_F(CsvScene, OneFileIsOneModelHoweverItIsSpelled) {
  folder.tree("far/birch.glb");
  std::filesystem::create_symlink(folder / "birch.glb", folder / "same.glb");
  const Scene scene = read("birch.glb,0,0,0\n./far/../birch.glb,0,0,0\nsame.glb,0,0,0\n" +
                           (folder / "birch.glb").string() + ",0,0,0\nfar/birch.glb,0,0,0\n");
  ASSERT_EQ(scene.models.size(), 2u);
  EXPECT_EQ(scene.models[0].name, "birch");
  EXPECT_EQ(scene.models[1].name, "birch-2");
  EXPECT_EQ(scene.trees[3].model, 0u);
  EXPECT_EQ(scene.trees[4].model, 1u);
}

TEST_F(CsvScene, NamesStayApartFromThoseMadeUp) {
  folder.tree("a/birch.glb");
  folder.tree("birch-2.glb");
  const Scene scene = read("birch-2.glb,0,0,0\nbirch.glb,0,0,0\na/birch.glb,0,0,0\n");
  ASSERT_EQ(scene.models.size(), 3u);
  EXPECT_EQ(scene.models[2].name, "birch-3");
}

TEST_F(CsvScene, TreesThatCannotStandAreSkippedAndCounted) {
  const Scene scene = read(
      "model,x,y,z,qx,qy,qz,qw,scale\n"
      "birch.glb,0,0,0,0,0,0,1,1\n"
      "birch.glb,0,0,0,0,0,0,1,0\n"      // the scale is zero
      "missing.glb,0,0,0,0,0,0,1,nan\n"  // the model of a skipped tree may be missing
      "birch.glb,0,inf,0,0,0,0,1,1\n"
      "birch.glb,0,0,0,0,0,0,0,1\n"  // the rotation is zero
      "ash.glb,0,0,0,0,0,0,1,1e-60\n"
      "ash.glb,0,0,0,0,0,0,1,1e60\n"
      "birch.glb,0,0,0,0,0,0,1,-2\n");
  EXPECT_EQ(scene.trees.size(), 2u);
  EXPECT_EQ(scene.models.size(), 1u);
  EXPECT_EQ(scene.skipped, 6u);
  EXPECT_EQ(scene.trees[1].linear[0], -2);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_TRUE(
      scene.warnings[0].ends_with("scene.csv: 6 trees were skipped, the first at line 3: "
                                  "their scale is zero or a value is not finite"))
      << scene.warnings[0];
}

TEST_F(CsvScene, ThinAndTinyTreesStand) {
  const Scene scene = read(
      "model,x,y,z,rx,ry,rz,sx,sy,sz\nbirch.glb,0,0,0,10,20,30,1,1e-12,1\n"
      "birch.glb,0,0,0,10,20,30,1e-20,1e-20,1e-20\n");
  EXPECT_EQ(scene.trees.size(), 2u);
}

TEST_F(CsvScene, TwoTreesInOnePlace) {
  EXPECT_EQ(read("birch.glb,1,2,3\nbirch.glb,1,2,3\n").trees.size(), 2u);
}

TEST_F(CsvScene, BadLinesAreNamed) {
  refuse("", "scene.csv holds no trees");
  refuse("model,x,y,z\n# nothing\n", "scene.csv holds no trees");
  refuse("model,x,y,z,scale\nbirch.glb,1,2,3,0\n",
         "scene.csv holds no tree that can be placed: of all 1 the scale is zero or a value is not "
         "finite, the first at line 2");
  refuse("model,x,y,z\n\nbirch.glb,1,2,3\nbirch.glb,1,two,3\n",
         "scene.csv, line 4: \"two\" in column y is not a number");
  refuse("model,x,y,z\nbirch.glb,1,2,\n", "scene.csv, line 2: \"\" in column z is not a number");
  refuse("model,x,y,z\nbirch.glb,1,2,1.5m\n",
         "scene.csv, line 2: \"1.5m\" in column z is not a number");
  refuse("model,x,y,z\nbirch.glb,1,2\n",
         "scene.csv, line 2: has 3 fields where the first line has 4");
  refuse("model,x,y,z\nbirch.glb,1,2,3,4\n",
         "scene.csv, line 2: has 5 fields where the first line has 4");
  refuse("model,x,y,z\noak.glb,1,2,3\n",
         "scene.csv, line 2: the tree file oak.glb is not there: No such file or directory");
  refuse("model,x,y,z\n.,1,2,3\n",
         "scene.csv, line 2: the tree file . is not there: Is a directory");
  refuse("model,x,y,z\n\"\",1,2,3\n", "scene.csv, line 2: its model is empty");
  refuse("model,x,y,z\n\"birch.glb,1,2,3\n", "scene.csv, line 2: a quote is not closed");
  refuse("model,x,y,z\n\"birch\".glb,1,2,3\n", "scene.csv, line 2: text follows a quoted field");
}

TEST_F(CsvScene, BadColumnsAreNamed) {
  refuse("birch.glb\n", "scene.csv, line 1: names no column model");
  refuse("x,y,z\n", "scene.csv, line 1: names no column model");
  refuse("model,x,z\n", "scene.csv, line 1: names no column y");
  refuse("model,age\n", "scene.csv, line 1: names no column x");
  refuse("model,x,y,z,x\n", "scene.csv, line 1: names the column x twice");
  refuse("model,x,y,z,qx,qy,qz\n", "scene.csv, line 1: names no column qw");
  refuse("model,x,y,z,yaw,rx,ry,rz\n", "scene.csv, line 1: names both yaw and rx");
  refuse("model,x,y,z,scale,sx,sy,sz\n", "scene.csv, line 1: names both scale and sx");
}

TEST_F(CsvScene, OtherFilesAreNoScenes) {
  expect_refused(folder, folder / "none.csv",
                 "none.csv: cannot be read: No such file or directory");
  std::filesystem::create_directory(folder / "folder.csv");
  expect_refused(folder, folder / "folder.csv", "folder.csv: cannot be read: Is a directory");
  refuse("\xFF\xFEm", "scene.csv: is UTF-16 text");
  expect_refused(folder, folder.write("tree.obj", "v 0 0 0\n"), "tree.obj is not a scene");
  EXPECT_EQ(read("birch.glb,1,2,3\n", "SCENE.CSV").trees.size(), 1u);
}

}  // namespace
}  // namespace leafhull
