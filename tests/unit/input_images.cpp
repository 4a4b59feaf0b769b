// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "glb_builder.h"
#include "input/gltf.h"
#include "read_built.h"
#include "temporary_folder.h"

namespace leafhull::test {
namespace {

const Bytes kPixels{1, 2, 3, 255, 4, 5, 6, 0, 7, 8, 9, 128, 10, 11, 12, 64};

GlbBuilder textured() {
  GlbBuilder b;
  const int material = b.add_material("leaf", "MASK", b.add_texture(2, 2, kPixels));
  b.add_node("n", b.add_mesh("m", {square(material)}));
  return b;
}

TEST(Images, DecodesTheBaseColourToRgba) {
  GlbBuilder b = textured();
  b.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}});
  b.json["textures"][0]["sampler"] = 0;
  b.json["materials"][0]["alphaCutoff"] = 0.25;
  b.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1, 0.25, 1};
  const TreeModel tree = read(b);
  ASSERT_EQ(tree.images.size(), 1u);
  EXPECT_EQ(tree.images[0].width, 2);
  EXPECT_EQ(tree.images[0].height, 2);
  EXPECT_EQ(tree.images[0].rgba, kPixels);
  const Material& material = tree.materials[0];
  EXPECT_EQ(material.base_color_image, 0);
  EXPECT_EQ(material.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(material.alpha_cutoff, 0.25);
  EXPECT_EQ(material.base_color, (std::array<float, 4>{0.5f, 1, 0.25f, 1}));
  EXPECT_EQ(material.wrap_u, Wrap::clamp);
  EXPECT_EQ(material.wrap_v, Wrap::mirror);
}

TEST(Images, DecodesOnlyWhatAPrimitiveShows) {
  GlbBuilder b = textured();
  const int other = b.add_texture(2, 2, kPixels);
  b.add_material("unused", "OPAQUE", other);
  b.json["materials"][0]["normalTexture"] = {{"index", other}};
  const TreeModel tree = read(b);
  EXPECT_EQ(tree.images.size(), 1u);
  EXPECT_EQ(tree.materials[1].base_color_image, -1);
}

TEST(Images, WarnsOfMissingAndBrokenTextures) {
  const auto warning = [](const GlbBuilder& b) {
    const TreeModel tree = read(b);
    EXPECT_EQ(tree.primitives.size(), 1u);
    EXPECT_EQ(tree.materials[0].base_color_image, 0);
    EXPECT_TRUE(tree.images[0].empty());
    EXPECT_EQ(tree.warnings.size(), 1u);
    return tree.warnings.empty() ? "" : tree.warnings[0];
  };
  GlbBuilder broken = textured();
  broken.bin[0] = 0;
  EXPECT_NE(warning(broken).find("not a PNG or JPEG"), std::string::npos);
  GlbBuilder cut = textured();
  cut.json["bufferViews"][0]["byteLength"] = 40;
  EXPECT_NE(warning(cut).find("images[0]"), std::string::npos);
  GlbBuilder outside = textured();
  outside.json["images"][0]["bufferView"] = 99;
  EXPECT_NE(warning(outside).find("bufferViews[99]"), std::string::npos);
  GlbBuilder no_image = textured();
  no_image.json["textures"][0]["source"] = 7;
  EXPECT_NE(warning(no_image).find("images[7]"), std::string::npos);
  GlbBuilder basis = textured();
  basis.json["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
  basis.bin[0] = 0xAB;  // as KTX2 files begin
  basis.json["extensionsRequired"] = {"KHR_texture_basisu"};
  warning(basis);
}

TEST(Images, RefusesSizesThatNoFileOfItsLengthHolds) {
  GlbBuilder b = textured();
  b.bin[16] = 0x7F;  // the width in the PNG header
  const TreeModel tree = read(b);
  EXPECT_TRUE(tree.images[0].empty());
  EXPECT_EQ(tree.warnings.size(), 1u);
}

TEST(Images, ReadsExternalFilesAndWarnsWhereTheyAreMissing) {
  const TemporaryFolder folder;
  GlbBuilder b = textured();
  b.json["images"][0] = {{"uri", "leaf%20mask.png"}};
  const Bytes glb = b.glb(), file = png(2, 2, kPixels);
  EXPECT_EQ(read_gltf(glb, "t.glb", Companions(folder / "t.glb", false)).warnings.size(), 1u);
  std::ofstream(folder / "leaf mask.png", std::ios::binary)
      .write(reinterpret_cast<const char*>(file.data()), std::streamsize(file.size()));
  const TreeModel tree = read_gltf(glb, "t.glb", Companions(folder / "t.glb", false));
  EXPECT_TRUE(tree.warnings.empty());
  EXPECT_EQ(tree.images[0].rgba, kPixels);
}

TEST(Images, AppliesTheTextureTransform) {
  GlbBuilder b = textured();
  nlohmann::json& entry = b.json["meshes"][0]["primitives"][0];
  entry["attributes"]["TEXCOORD_1"] =
      b.add_accessor(std::vector<Vec2f>{{1, 0}, {0, 1}, {0, 0}, {1, 1}});
  b.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
      {"KHR_texture_transform",
       {{"offset", {10, 20}},
        {"rotation", std::numbers::pi / 2},
        {"scale", {2, 3}},
        {"texCoord", 1}}}};
  const std::vector<Vec2f> uvs = read(b).primitives[0].uvs;
  // Counter-clockwise as seen, with v down: (1, 0) goes to (0, -1), (0, 1) to (1, 0).
  const std::vector<Vec2f> expected{{10, 18}, {13, 20}, {10, 20}, {13, 18}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(uvs[i].x, expected[i].x, 1e-5);
    EXPECT_NEAR(uvs[i].y, expected[i].y, 1e-5);
  }
}

TEST(Images, TakesTheDiffuseTextureOfSpecularGlossiness) {
  GlbBuilder b = textured();
  b.json["materials"][0].erase("pbrMetallicRoughness");
  b.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
      {"diffuseTexture", {{"index", 0}}}, {"diffuseFactor", {0, 1, 0, 0.5}}};
  const TreeModel tree = read(b);
  EXPECT_EQ(tree.images[0].rgba, kPixels);
  EXPECT_EQ(tree.materials[0].base_color, (std::array<float, 4>{0, 1, 0, 0.5f}));
}

}  // namespace
}  // namespace leafhull::test
