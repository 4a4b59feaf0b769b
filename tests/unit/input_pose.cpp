// SPDX-License-Identifier: Apache-2.0
// Skins, morph targets and invisible things in glTF.
#include <gtest/gtest.h>

#include <cmath>

#include "glb_builder.h"
#include "leafhull/error.h"
#include "read_built.h"

namespace leafhull::test {
namespace {

using nlohmann::json;

Vec3d placed_vertex(const TreeModel& tree, std::size_t vertex, std::size_t number = 0) {
  const Instance& instance = tree.instances.at(number);
  const Vec3f p = tree.primitives[instance.primitive].positions.at(vertex);
  const auto row = [&](std::size_t i) {
    const auto& r = instance.to_world[i];
    return r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3];
  };
  return {row(0), row(1), row(2)};
}

void expect_at(Vec3d a, Vec3d b) {
  EXPECT_LT(length(a - b), 1e-5) << a.x << ' ' << a.y << ' ' << a.z;
}

/// A square whose left side follows one joint and whose right side another. They are bound at the
/// origin and at x = 1; the second has since moved up by 3 and made a quarter turn about z.
GlbBuilder skinned() {
  GlbBuilder b;
  const int mesh = b.add_mesh("leaves", {square()});
  json& attributes = b.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = b.add_accessor(
      std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 5121, 4);
  attributes["WEIGHTS_0"] = b.add_accessor(
      std::vector<float>{1, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 5126, 4);
  std::vector<float> inverse{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  inverse.insert(inverse.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1});
  const int matrices = b.add_accessor(inverse, "MAT4", 5126, 2);
  const int still = b.add_node("still", -1);
  const double half = std::sqrt(0.5);
  const int moved =
      b.add_node("moved", -1, {{"translation", {1, 3, 0}}, {"rotation", {0, 0, half, half}}});
  b.add("skins", {{"joints", {still, moved}}, {"inverseBindMatrices", matrices}});
  b.add_node("tree", mesh, {{"skin", 0}, {"translation", {50, 0, 0}}, {"scale", {9, 9, 9}}});
  return b;
}

TEST(Skins, ArePosedByTheirJointsAndNotByTheirNode) {
  const TreeModel tree = read(skinned());
  ASSERT_EQ(tree.instances.size(), 1u);
  expect_at(placed_vertex(tree, 0), {0, 0, 0});
  expect_at(placed_vertex(tree, 3), {0, 1, 0});
  expect_at(placed_vertex(tree, 1), {1, 3, 0});
  expect_at(placed_vertex(tree, 2), {0, 3, 0});  // at (0, 1) of the turned joint
  EXPECT_TRUE(tree.warnings.empty());
}

TEST(Skins, TurnNormalsToo) {
  GlbBuilder b = skinned();
  b.json["nodes"][1]["rotation"] = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // about x
  const TreeModel tree = read(b);
  const Primitive& primitive = tree.primitives[0];
  expect_at(Vec3d(primitive.normals[0]), {0, 0, 1});
  expect_at(Vec3d(primitive.normals[1]), {0, -1, 0});
}

TEST(Skins, OfOneMeshMayDiffer) {
  GlbBuilder b = skinned();
  b.json["skins"].push_back(b.json["skins"][0]);
  b.json["skins"][1]["joints"] = {1, 0};
  b.add_node("other", 0, {{"skin", 1}});
  b.add_node("plain", 0, {{"translation", {7, 0, 0}}});
  const TreeModel tree = read(b);
  ASSERT_EQ(tree.instances.size(), 3u);
  EXPECT_EQ(tree.primitives.size(), 3u);
  expect_at(placed_vertex(tree, 0, 0), {0, 0, 0});
  expect_at(placed_vertex(tree, 0, 1), {1, 3, 0});
  expect_at(placed_vertex(tree, 2, 2), {8, 1, 0});
}

TEST(Skins, WithoutJointsMoveNothing) {
  GlbBuilder b = skinned();
  b.json["meshes"][0]["primitives"][0]["attributes"].erase("JOINTS_0");
  expect_at(placed_vertex(read(b), 0), {50, 0, 0});
}

TEST(Skins, PoseWhatHasJoints) {
  GlbBuilder b = skinned();
  b.json["meshes"][0]["primitives"].push_back(
      {{"attributes", {{"POSITION", b.add_accessor(square().positions)}}},
       {"indices", b.add_accessor(square().indices)}});
  const TreeModel tree = read(b);
  ASSERT_EQ(tree.instances.size(), 2u);
  expect_at(placed_vertex(tree, 1, 0), {1, 3, 0});
  expect_at(placed_vertex(tree, 1, 1), {1, 0, 0});
  ASSERT_EQ(tree.warnings.size(), 1u);
  EXPECT_NE(tree.warnings[0].find("has no joints"), std::string::npos) << tree.warnings[0];
}

TEST(Skins, ThatAreDamagedAreErrors) {
  const auto expect_error_of = [](const GlbBuilder& b, const std::string& part) {
    try {
      read(b);
      ADD_FAILURE() << "no error, expected " << part;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::input);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  GlbBuilder b = skinned();
  b.json["nodes"][2]["skin"] = 4;
  expect_error_of(b, "skins[4]");
  b = skinned();
  b.json["skins"][0]["joints"] = {0};
  expect_error_of(b, "a joint is past its skin's 1");
  b = skinned();
  b.json["skins"][0]["joints"] = {0, 77};
  expect_error_of(b, "nodes[77]");
  b = skinned();
  b.json["skins"][0]["joints"] = {0, 1, 2};
  expect_error_of(b, "fewer inverse bind matrices");
  b = skinned();
  b.json["skins"][0]["joints"] = {0, "1"};
  expect_error_of(b, "joints is \"1\"");
  b = skinned();
  b.json["skins"][0]["inverseBindMatrices"] = 0;
  expect_error_of(b, "MAT4");
  b = skinned();
  b.json["nodes"][1]["translation"] = {1e300, 0, 0};
  expect_error_of(b, "not finite");
}

/// The first target moves all vertices up by 2, the second to the right by 1.
GlbBuilder morphed() {
  GlbBuilder b;
  const int mesh = b.add_mesh("leaves", {square()});
  const int up = b.add_accessor(std::vector<Vec3f>(4, {0, 2, 0}));
  const int right = b.add_accessor(std::vector<Vec3f>(4, {1, 0, 0}));
  b.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", up}}, {{"POSITION", right}}};
  b.add_node("tree", mesh, {{"translation", {0, 0, 5}}});
  return b;
}

TEST(Morphs, MoveByTheirWeights) {
  GlbBuilder b = morphed();
  expect_at(placed_vertex(read(b), 0), {0, 0, 5});
  b.json["meshes"][0]["weights"] = {0.5, 1};
  expect_at(placed_vertex(read(b), 0), {1, 1, 5});
  b.json["nodes"][0]["weights"] = {0, 2};  // these override the mesh's
  expect_at(placed_vertex(read(b), 2), {3, 1, 5});
  b.json["nodes"][0]["weights"] = {0, 0};
  expect_at(placed_vertex(read(b), 2), {1, 1, 5});
  b.json["nodes"][0]["weights"] = {"1"};
  EXPECT_THROW(read(b), Error);
  b = morphed();
  b.json["nodes"][0]["weights"] = {1};
  b.json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] =
      b.add_accessor(std::vector<Vec3f>(3));
  EXPECT_THROW(read(b), Error);
}

TEST(Visibility, HiddenNodesAndWhatIsBelowThemStayOut) {
  GlbBuilder b;
  const int mesh = b.add_mesh("leaves", {square()});
  b.add_node("seen", mesh, {{"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}});
  b.add_node("hidden", -1,
             {{"children", {2}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
  b.add("nodes", {{"name", "below"}, {"mesh", mesh}});
  b.json["extensionsRequired"] = {"KHR_node_visibility"};
  const TreeModel tree = read(b);
  ASSERT_EQ(tree.instances.size(), 1u);
  EXPECT_EQ(tree.instances[0].node_name, "seen");
  ASSERT_EQ(tree.warnings.size(), 1u);
  EXPECT_EQ(tree.warnings[0], "1 hidden mesh is passed over");
}

}  // namespace
}  // namespace leafhull::test
