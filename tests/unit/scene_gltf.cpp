// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "scene_files.h"

namespace leafhull {
namespace {

using nlohmann::json;
using test::expect_near;
using test::GlbBuilder;
using test::leaves_in_a_row;
using test::moved;
using test::square;

class GltfScene : public testing::Test {
 protected:
  Scene read(const GlbBuilder& builder, const LeafOptions& leaves = {}) {
    return read_scene(folder.write("forest.glb", builder.glb()), leaves);
  }

  /// Adds ground, and two kinds of trees with bark and with 20 and 40 leaves.
  GlbBuilder forest() {
    GlbBuilder builder;
    const int bark = builder.add_material("bark");
    const std::vector<std::uint8_t> pixels(4 * 4 * 4, 255);
    const int leaf = builder.add_material("green", "MASK", builder.add_texture(4, 4, pixels));
    birch_ = builder.add_mesh("tree", {square(bark), leaves_in_a_row(20, leaf)});
    ash_ = builder.add_mesh("tree", {leaves_in_a_row(40, leaf), square(bark)});
    ground_ = builder.add_mesh("ground", {square(bark)});
    builder.add_node("ground", ground_);
    return builder;
  }

  /// Copies of a mesh by EXT_mesh_gpu_instancing.
  static json instanced(GlbBuilder& builder, const std::vector<Vec3f>& translations,
                        const std::vector<Vec3f>& scales) {
    json attributes = {{"TRANSLATION", builder.add_accessor(translations)},
                       {"SCALE", builder.add_accessor(scales)}};
    return {{"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}};
  }

  int birch_ = 0, ash_ = 0, ground_ = 0;
  test::SceneFolder folder;
};

TEST_F(GltfScene, NodesThatShareAMeshAreTreesOfOneModel) {
  GlbBuilder builder = forest();
  builder.add_node("b1", birch_, {{"translation", {1, 2, 3}}});
  builder.add_node("a1", ash_, {{"scale", {2, 2, 2}}});
  const int child = builder.add("nodes", {{"mesh", birch_}, {"translation", {0, 0, 1}}});
  builder.add_node("group", -1, {{"rotation", {0, 1, 0, 1}}, {"children", {child}}});

  const Scene scene = read(builder);
  ASSERT_EQ(scene.models.size(), 2u) << "the ground is none, and two meshes of one name are two";
  EXPECT_EQ(scene.models[0].name, "tree");
  EXPECT_EQ(scene.models[1].name, "tree-2");
  EXPECT_EQ(scene.models[1].mesh, "tree");
  ASSERT_EQ(scene.trees.size(), 3u);
  EXPECT_EQ(scene.trees[0].position, Vec3d(1, 2, 3));
  EXPECT_EQ(scene.trees[1].model, 1u);
  EXPECT_EQ(scene.trees[1].linear[4], 2);
  EXPECT_EQ(scene.trees[2].model, 0u);
  expect_near(moved(scene.trees[2], {1, 0, 0}), {1, 0, -1});
  EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(GltfScene, ModelsAreTheirMeshesAtTheOrigin) {
  GlbBuilder builder = forest();
  builder.add_node("b", birch_, {{"translation", {1, 2, 3}}});
  builder.add_node("a", ash_, {{"scale", {2, 2, 2}}});
  const Scene scene = read(builder);
  ASSERT_EQ(scene.models.size(), 2u);
  const LeafSet birch = read_model(scene.models[0], {}), ash = read_model(scene.models[1], {});
  EXPECT_EQ(birch.leaf_count, 20u);
  EXPECT_EQ(ash.leaf_count, 40u);
  EXPECT_EQ(birch.bounds.high, Vec3d(39, 1, 0));
  EXPECT_EQ(ash.bounds.high, Vec3d(79, 1, 0));
}

TEST_F(GltfScene, ModelsShareTheirImagesAndTheGroundIsFreed) {
  GlbBuilder builder = forest();
  builder.add_node("b", birch_);
  builder.add_node("a", ash_);
  const Scene scene = read(builder);
  ASSERT_EQ(scene.models.size(), 2u);
  EXPECT_EQ(scene.models[0].meshes, scene.models[1].meshes);
  const TreeModel& meshes = *scene.models[0].meshes;
  EXPECT_EQ(meshes.images.size(), 1u);
  EXPECT_FALSE(meshes.images[0].empty());
  for (const Primitive& primitive : meshes.primitives) {
    EXPECT_EQ(primitive.positions.empty(), primitive.mesh_name != "tree");
  }
}

TEST_F(GltfScene, CopiesOfInstancingAreTrees) {
  GlbBuilder builder = forest();
  json node =
      instanced(builder, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{1, 1, 1}, {1, 2, 1}, {3, 3, 3}});
  node["translation"] = {0, 10, 0};
  builder.add_node("stand", birch_, node);
  const Scene scene = read(builder);
  ASSERT_EQ(scene.trees.size(), 3u);
  EXPECT_EQ(scene.models.size(), 1u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(scene.trees[i].position, Vec3d(i, 10, 0));
  EXPECT_EQ(scene.trees[1].linear, (std::array<float, 9>{1, 0, 0, 0, 2, 0, 0, 0, 1}));
  EXPECT_EQ(scene.trees[2].linear[8], 3);
}

TEST_F(GltfScene, SkipsAndCountsTreesThatCannotStand) {
  GlbBuilder builder = forest();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  builder.add_node("flat", birch_, {{"scale", {1, 0, 1}}});
  builder.add_node("no rotation", birch_, {{"rotation", {0, 0, 0, 0}}});
  builder.add_node(
      "stand", birch_,
      instanced(builder, {{0, 0, 0}, {nan, 0, 0}, {2, 0, 0}}, {{1, 1, 1}, {1, 1, 1}, {0, 1, 1}}));
  builder.add_node("the ground has no scale, which is no matter", ground_, {{"scale", {0, 0, 0}}});
  const Scene scene = read(builder);
  EXPECT_EQ(scene.trees.size(), 1u);
  EXPECT_EQ(scene.skipped, 4u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_TRUE(
      scene.warnings[0].ends_with("forest.glb: 4 trees were skipped, the first at nodes[1]: "
                                  "their scale is zero or a value is not finite"))
      << scene.warnings[0];
}

TEST_F(GltfScene, ColumnsInOnePlaneCannotStand) {
  GlbBuilder builder = forest();
  builder.add_node("sheared", birch_,
                   {{"matrix", {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}});
  builder.add_node("flat", birch_,
                   {{"matrix", {.1, .2, .3, 0, .4, .5, .6, 0, .51, .72, .93, 0, 0, 0, 0, 1}}});
  const Scene scene = read(builder);
  EXPECT_EQ(scene.skipped, 1u);
  ASSERT_EQ(scene.trees.size(), 1u);
  expect_near(moved(scene.trees[0], {0, 1, 0}), {6, 1, 0});
}

TEST_F(GltfScene, NamesOfNodesChooseLeavesToo) {
  GlbBuilder builder;
  const int plain = builder.add_material("plain");
  const int mesh = builder.add_mesh("", {leaves_in_a_row(30, plain)});
  builder.add_node("crown.001", mesh);
  builder.add_node("crown.002", mesh, {{"translation", {9, 0, 0}}});
  builder.add_node("rock", mesh);
  LeafOptions crowns;
  crowns.globs = {"CROWN*"};
  const Scene scene = read(builder, crowns);
  ASSERT_EQ(scene.models.size(), 1u);
  EXPECT_EQ(scene.models[0].name, "mesh-0");
  EXPECT_EQ(scene.trees.size(), 2u);
  EXPECT_EQ(read_model(scene.models[0], crowns).leaf_count, 30u);
}

TEST_F(GltfScene, WithoutLeavesItListsWhatThereIs) {
  GlbBuilder builder = forest();
  test::expect_refused(folder, folder.write("forest.glb", builder.glb()),
                       "no leaves in forest.glb: names, holes, colours and shapes show "
                       "none; it holds materials bark; meshes ground; nodes ground");
  test::expect_refused(folder, folder.write("empty.glb", GlbBuilder().glb()),
                       "empty.glb holds no triangles");
  test::expect_refused(folder, folder.write("not.glb", std::string("model,x,y,z\n")),
                       "not.glb: JSON: parse error at line 1, column 1: syntax error while parsing "
                       "value - invalid literal; last read: 'm'");
}

TEST_F(GltfScene, OneTreeOfManyNodesGetsAWarning) {
  GlbBuilder builder;
  const int leaf = builder.add_material("leaf", "MASK");
  const int twig = builder.add_mesh("twig", {leaves_in_a_row(3, leaf)});
  for (int i = 0; i < 5; ++i) builder.add_node("twig", twig);
  const Scene scene = read(builder);
  EXPECT_EQ(scene.trees.size(), 5u);
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("looks like one tree"), std::string::npos);
  EXPECT_EQ(scene.warnings[0].find('\n'), std::string::npos);
}

}  // namespace
}  // namespace leafhull
