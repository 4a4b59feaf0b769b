// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "glb_builder.h"
#include "input/gltf.h"
#include "leafhull/error.h"
#include "leafhull/tree.h"
#include "temporary_folder.h"

namespace leafhull::test {
namespace {

const Bytes kTwoPixels{1, 2, 3, 255, 4, 5, 6, 0};

std::string base64(const Bytes& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t count = std::min<std::size_t>(bytes.size() - at, 3);
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i) group = group << 8 | (i < count ? bytes[at + i] : 0u);
    for (std::size_t i = 0; i < 4; ++i) {
      text += i <= count ? kDigits[group >> (18 - 6 * i) & 63] : '=';
    }
  }
  return text;
}

/// A folder for a tree and the files that it names, inside another for files above it.
class GltfFiles : public testing::Test {
 protected:
  void write(const std::string& name, const Bytes& bytes) const {
    const std::filesystem::path file = above_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  }
  void write_image(const std::string& name) const { write(name, png(2, 1, kTwoPixels)); }

  /// A textured square whose image has this URI.
  static GlbBuilder square_with_image(const std::string& uri) {
    GlbBuilder b;
    b.add("images", {{"uri", uri}});
    const int material = b.add_material("leaf", "MASK", b.add("textures", {{"source", 0}}));
    b.add_node("n", b.add_mesh("m", {square(material)}));
    return b;
  }
  static GlbBuilder square_with_buffer(const std::string& uri) {
    GlbBuilder b;
    b.add_node("n", b.add_mesh("m", {square()}));
    b.json["buffers"] = {{{"byteLength", b.bin.size()}, {"uri", uri}}};
    return b;
  }

  TreeModel read(const GlbBuilder& builder, const ReadOptions& options = {}) const {
    write("trees/t.glb", builder.glb());
    return read_tree(above_ / "trees/t.glb", options);
  }

  void expect_image(const std::string& uri) const {
    const TreeModel tree = read(square_with_image(uri));
    EXPECT_TRUE(tree.warnings.empty()) << uri << ": " << tree.warnings[0];
    EXPECT_EQ(tree.images.at(0).rgba, kTwoPixels) << uri;
  }
  void expect_image(const std::string& uri, const std::string& warning) const {
    const TreeModel tree = read(square_with_image(uri));
    ASSERT_EQ(tree.warnings.size(), 1u) << uri;
    EXPECT_NE(tree.warnings[0].find(warning), std::string::npos) << tree.warnings[0];
    EXPECT_EQ(tree.images.at(0).rgba, kTwoPixels) << uri;
  }

  TemporaryFolder above_;
};

TEST_F(GltfFiles, UrisAreWrittenInManyWays) {
  write_image("trees/textures/a leaf.png");
  write_image("trees/what?#.png");
  for (const char* uri :
       {"textures/a leaf.png", "textures/a%20leaf.png", "textures\\a leaf.png",
        ".\\textures\\a%20leaf.png", "textures/a%20leaf.png?v=3", "textures/a leaf.png#top",
        "textures%2Fa leaf.png", "what?#.png", "what%3F%23.png"}) {
    expect_image(uri);
  }
}

TEST_F(GltfFiles, BuffersAreFoundAsImagesAre) {
  const GlbBuilder b = square_with_buffer("Bin dir\\tree.bin?v=2");
  write("trees/bin dir/tree.bin", b.bin);
  const TreeModel tree = read(b);
  EXPECT_EQ(tree.primitives.at(0).positions, square().positions);
  ASSERT_EQ(tree.warnings.size(), 1u);
  EXPECT_TRUE(tree.warnings[0].starts_with("buffers[0]: ")) << tree.warnings[0];
  EXPECT_NE(tree.warnings[0].find("bin dir/tree.bin"), std::string::npos) << tree.warnings[0];
}

TEST_F(GltfFiles, FilesInOtherCaseOrPlaceAreSaid) {
  write_image("trees/Textures/Leaf.PNG");
  expect_image("textures/leaf.png", "does not exist; used instead is");
  expect_image("maps/leaf.png", "Textures/Leaf.PNG");
  expect_image("C:/Users/Ann/leaf.png", "is taken from the file's own folder");
  expect_image("file:///C:/Users/Ann/leaf.png", "is taken from the file's own folder");
  expect_image("../../leaf.png", "is taken from the file's own folder");
}

TEST_F(GltfFiles, DataUrisNeedNoMediaTypeThatIsKnown) {
  const std::string image = base64(png(2, 1, kTwoPixels));
  for (const char* head :
       {"data:image/png;base64,", "data:;base64,", "data:image/png;charset=utf-8;base64,",
        "data:image/png;BASE64,", "data:image/x-png;base64,", "data:image/jpg;base64,"}) {
    expect_image(head + image);
  }
  expect_image("data:image/png;base64," + image.substr(0, 20) + "\r\n " + image.substr(20));
  const GlbBuilder b = square_with_buffer("");
  for (const char* head : {"data:;base64,", "data:application/gltf-buffer;BASE64,"}) {
    EXPECT_EQ(read(square_with_buffer(head + base64(b.bin))).primitives.at(0).positions,
              square().positions);
  }
}

TEST_F(GltfFiles, FilesAboveTheFolderAreReadOnlyWhereAllowed) {
  write_image("shared/leaf.png");
  for (const std::string& uri :
       {std::string("../shared/leaf.png"), std::string("..\\shared\\leaf.png"),
        std::string("none/../../shared/leaf.png"), (above_ / "shared/leaf.png").string(),
        "file://" + (above_ / "shared/leaf.png").string()}) {
    const TreeModel refused = read(square_with_image(uri));
    EXPECT_TRUE(refused.images.at(0).empty()) << uri;
    ASSERT_EQ(refused.warnings.size(), 1u);
    EXPECT_NE(refused.warnings[0].find("outside"), std::string::npos) << refused.warnings[0];

    const TreeModel allowed = read(square_with_image(uri), {.up = {}, .allow_outside = true});
    EXPECT_EQ(allowed.images.at(0).rgba, kTwoPixels) << uri;
    EXPECT_TRUE(allowed.warnings.empty()) << uri;
  }

  const GlbBuilder b = square_with_buffer("../shared/tree.bin");
  write("shared/tree.bin", b.bin);
  EXPECT_THROW(read(b), Error);
  EXPECT_EQ(read(b, {.up = {}, .allow_outside = true}).primitives.size(), 1u);
}

TEST_F(GltfFiles, BytesAfterTheEndArePassedOver) {
  GlbBuilder b;
  b.add_node("n", b.add_mesh("m", {square()}));
  Bytes bytes = b.glb();
  bytes.insert(bytes.end(), 17, 0);
  const TreeModel tree = read_gltf(bytes, "t.glb", {});
  EXPECT_EQ(tree.primitives.at(0).positions, square().positions);
  ASSERT_EQ(tree.warnings.size(), 1u);
  EXPECT_EQ(tree.warnings[0], "the 17 bytes after the end of the GLB are passed over");
}

TEST_F(GltfFiles, LinksOutOfTheFolderAreNotFollowed) {
  write_image("secret.png");
  std::filesystem::create_directories(above_ / "trees");
  std::filesystem::create_symlink(above_ / "secret.png", above_ / "trees/link.png");
  const TreeModel tree = read(square_with_image("link.png"));
  ASSERT_EQ(tree.warnings.size(), 1u);
  EXPECT_NE(tree.warnings[0].find("leads out of the file's folder"), std::string::npos)
      << tree.warnings[0];
  ReadOptions options;
  options.allow_outside = true;
  EXPECT_TRUE(read(square_with_image("link.png"), options).warnings.empty());
  write_image("trees/own.png");
  std::filesystem::create_symlink("own.png", above_ / "trees/inner.png");
  EXPECT_TRUE(read(square_with_image("inner.png")).warnings.empty());
}

}  // namespace
}  // namespace leafhull::test
