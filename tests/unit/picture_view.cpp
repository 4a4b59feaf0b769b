// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>

#include "glb_builder.h"
#include "leafhull/error.h"
#include "leafhull/render.h"
#include "leafhull/tree.h"
#include "temporary_folder.h"

namespace leafhull::test {
namespace {

class Cameras : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, std::string_view bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  std::filesystem::path write(const GlbBuilder& builder) {
    const Bytes glb = builder.glb();
    return write("camera.glb", {reinterpret_cast<const char*>(glb.data()), glb.size()});
  }

  /// Expects an error of one line that names the file and holds `part`.
  void expect_error(const std::filesystem::path& file, const std::string& part) {
    try {
      read_view(file);
      ADD_FAILURE() << "no error with " << part;
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_EQ(error.code(), ErrorCode::input);
      EXPECT_NE(message.find(part), std::string::npos) << message << " lacks " << part;
      EXPECT_NE(message.find(file.string()), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_FALSE(error.remedy().empty());
    }
  }
  void expect_json_error(const std::string& text, const std::string& part) {
    expect_error(write("camera.json", text), part);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Cameras, ReadsJson) {
  const View all = read_view(write(
      "all.json", R"({"eye": [1, 2.5, 3e1], "target": [4, 5, 6], "up": [0, 0, 1], "angle": 40})"));
  EXPECT_EQ(all.eye, Vec3d(1, 2.5, 30));
  EXPECT_EQ(all.target, Vec3d(4, 5, 6));
  EXPECT_EQ(all.up, Vec3d(0, 0, 1));
  EXPECT_EQ(all.angle, 40);
  const View least = read_view(write("least.json", R"({"target": [0, 0, 0], "eye": [0, 0, 9]})"));
  EXPECT_EQ(least.up, View().up);
  EXPECT_EQ(least.angle, View().angle);
}

TEST_F(Cameras, NamesTheKeyThatIsWrong) {
  expect_json_error("", "JSON");
  expect_json_error("{", "JSON");
  expect_json_error("[1, 2]", "JSON object");
  expect_json_error(R"({"target": [0, 0, 0]})", "eye: is missing");
  expect_json_error(R"({"eye": [0, 0, 0]})", "target: is missing");
  expect_json_error(R"({"eye": [0, 0], "target": [0, 0, 1]})", "eye: ");
  expect_json_error(R"({"eye": [0, 0, "1"], "target": [0, 0, 1]})", "eye: ");
  expect_json_error(R"({"eye": 3, "target": [0, 0, 1]})", "eye: ");
  expect_json_error(R"({"eye": [0, 0, 1], "target": [0, 0, 1]})", "target: ");
  const std::string good = R"("eye": [0, 0, 1], "target": [0, 0, 0], )";
  expect_json_error("{" + good + R"("up": [0, 0, 3]})", "up: ");
  expect_json_error("{" + good + R"("up": [0, 0, 0]})", "up: ");
  expect_json_error("{" + good + R"("up": "y"})", "up: ");
  expect_json_error("{" + good + R"("angle": 0})", "angle: ");
  expect_json_error("{" + good + R"("angle": 180})", "angle: ");
  expect_json_error("{" + good + R"("angle": "wide"})", "angle: ");
  expect_json_error("{" + good + R"("fov": 30})", "fov: ");
}

TEST_F(Cameras, SaysWhyAFileCannotBeRead) {
  expect_error("/nowhere/camera.json", "cannot be read");
  expect_error(std::filesystem::temp_directory_path(), "cannot be read");
}

GlbBuilder with_camera(const nlohmann::json& camera) {
  GlbBuilder builder;
  builder.add_node("trunk", builder.add_mesh("trunk", {square()}));
  builder.add("cameras", camera);
  return builder;
}

const nlohmann::json kPerspective = {{"type", "perspective"},
                                     {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}};

TEST_F(Cameras, FollowTheirNodes) {
  GlbBuilder builder = with_camera(kPerspective);
  // After a quarter turn about y the camera looks along -x. Its parent moves and enlarges it.
  builder.add("nodes", {{"camera", 0},
                        {"translation", {1, 0, 0}},
                        {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}});
  builder.add_node("rig", -1,
                   {{"children", {1}}, {"translation", {0, 5, 0}}, {"scale", {2, 2, 2}}});
  const View view = read_view(write(builder));
  EXPECT_NEAR(length(view.eye - Vec3d(2, 5, 0)), 0, 1e-6);
  EXPECT_NEAR(length(view.target - Vec3d(1, 5, 0)), 0, 1e-6);
  EXPECT_NEAR(length(normalized(view.up) - Vec3d(0, 1, 0)), 0, 1e-6);
  EXPECT_NEAR(view.angle, 28.6479, 1e-4);
}

TEST_F(Cameras, OfAGltfFileMustBeUsable) {
  expect_error(write(with_camera(kPerspective)), "no perspective camera");  // no node uses it
  GlbBuilder flat = with_camera({{"type", "orthographic"}, {"orthographic", {{"xmag", 1}}}});
  flat.add_node("camera", -1, {{"camera", 0}});
  expect_error(write(flat), "no perspective camera");
  GlbBuilder blind = with_camera({{"type", "perspective"}});
  blind.add_node("camera", -1, {{"camera", 0}});
  expect_error(write(blind), "cameras[0], yfov");
  GlbBuilder missing = with_camera(kPerspective);
  missing.add_node("camera", -1, {{"camera", 7}});
  expect_error(write(missing), "cameras[7]");
  GlbBuilder squashed = with_camera(kPerspective);
  squashed.add_node("camera", -1, {{"camera", 0}, {"scale", {1, 1, 0}}});
  expect_error(write(squashed), "nodes[1]");
}

TEST_F(Cameras, AreNobodysBusinessInATree) {
  GlbBuilder builder = with_camera({{"type", 7}, {"perspective", "wide"}});
  builder.add_node("camera", -1, {{"camera", 7}});
  EXPECT_EQ(read_tree(write(builder)).instances.size(), 1u);
}

}  // namespace
}  // namespace leafhull::test
