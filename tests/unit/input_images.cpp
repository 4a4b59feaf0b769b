// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <webp/encode.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>

#include "glb_builder.h"
#include "input/gltf.h"
#include "input/image_table.h"
#include "input/images.h"
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

// Images are decoded four at a time and kept in the order in which they were asked for.
TEST(Images, AreKeptUpToALimit) {
  TreeModel tree;
  ImageTable table(10 * 16);  // ten images of 2 x 2 pixels
  const auto load = [](const std::string& name) {
    ImageSource source{.name = name, .place = "place of " + name};
    source.load = [name]() -> leafhull::Bytes {
      if (name == "3") throw FileError("gone");
      const auto file = png(2, 2, kPixels);
      return leafhull::Bytes(file.begin(), file.end());
    };
    return source;
  };
  for (int i = 0; i < 12; ++i) EXPECT_EQ(table.number_of({std::to_string(i), ""}, load, tree), i);
  EXPECT_EQ(table.number_of({"5", ""}, load, tree), 5) << "each once";
  table.decode(tree);
  ASSERT_EQ(tree.images.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(tree.images[i].name, std::to_string(i));
    EXPECT_EQ(tree.images[i].empty(), i == 3 || i == 11) << i;
  }
  EXPECT_EQ(tree.warnings,
            (std::vector<std::string>{"place of 3: texture not read: gone",
                                      "place of 11: texture not read: the images of the file are "
                                      "larger than 2 GiB together"}));
}

TEST(Images, TellsInOneLineWhyThereIsNone) {
  const Bytes whole = png(2, 2, kPixels);
  for (const std::string& chunk : {std::string(4, '\0'), std::string("A\nB\n")}) {
    Bytes file = whole;
    std::copy(chunk.begin(), chunk.end(), file.begin() + 37);  // replaces IDAT
    std::string reason;
    EXPECT_TRUE(decode_image(file, "x.png", reason).empty());
    EXPECT_FALSE(reason.empty());
    EXPECT_EQ(reason.find('\n'), std::string::npos) << reason;
  }
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
  EXPECT_NE(warning(broken).find("format is unknown"), std::string::npos);
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
  basis.bin[0] = 0xAB;  // KTX2 files begin with this byte
  basis.json["extensionsRequired"] = {"KHR_texture_basisu"};
  warning(basis);
}

Bytes webp(int width, int height, const Bytes& rgba) {
  std::uint8_t* encoded = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &encoded);
  const Bytes bytes(encoded, encoded + size);
  WebPFree(encoded);
  return bytes;
}

TEST(Images, ReadsWebpAsAnExtensionAndAsAFile) {
  const Bytes opaque{1, 2, 3, 255, 4, 5, 6, 255, 7, 8, 9, 255, 10, 11, 12, 0};
  GlbBuilder b = textured();
  const int view = b.add_view(webp(2, 2, opaque));
  b.json["images"][0] = {{"bufferView", view}, {"mimeType", "image/webp"}};
  b.json["textures"][0] = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
  b.json["extensionsRequired"] = {"EXT_texture_webp"};
  const TreeModel tree = read(b);
  EXPECT_TRUE(tree.warnings.empty());
  EXPECT_EQ(tree.images[0].width, 2);
  EXPECT_EQ(Bytes(tree.images[0].rgba.begin(), tree.images[0].rgba.begin() + 12),
            Bytes(opaque.begin(), opaque.begin() + 12));
  EXPECT_EQ(tree.images[0].rgba[15], 0);

  std::string reason;
  EXPECT_EQ(decode_image(webp(2, 2, opaque), "leaf.webp", reason).height, 2);
  EXPECT_EQ(reason, "");
}

TEST(Images, OfDamagedWebpSayWhy) {
  const Bytes whole = webp(2, 2, kPixels);
  for (std::size_t size = 12; size < whole.size(); ++size) {
    std::string reason;
    const Image image = decode_image({whole.data(), size}, "leaf.webp", reason);
    EXPECT_EQ(image.empty(), !reason.empty()) << size;
  }
  Bytes wide = webp(1, 1, {1, 2, 3, 4});
  wide[21] = wide[22] = wide[23] = wide[24] = 0xFF;  // 16,384 x 16,384
  std::string reason;
  EXPECT_TRUE(decode_image(wide, "leaf.webp", reason).empty());
  EXPECT_NE(reason, "");
}

TEST(Images, OfOtherFormatsAreNamed) {
  const auto reason_of = [](const std::string& text, const std::string& name) {
    std::string reason;
    EXPECT_TRUE(decode_image(Bytes(text.begin(), text.end()), name, reason).empty());
    return reason;
  };
  EXPECT_NE(reason_of("\xABKTX 20\xBB\r\n\x1A\n", "a.ktx2").find("gltf-transform"),
            std::string::npos);
  EXPECT_NE(reason_of("DDS |", "a.dds").find("DDS; PNG, JPEG, WebP"), std::string::npos);
  EXPECT_NE(reason_of("GIF89a", "a.png").find("GIF"), std::string::npos);
  EXPECT_NE(reason_of("what", "a.png").find("format is unknown"), std::string::npos);
  EXPECT_NE(reason_of("", "a.png"), "");
}

TEST(Images, OfTgaAreKnownByTheirName) {
  // One uncompressed pixel of 32 bits: blue, green, red, alpha.
  const Bytes tga{0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 32, 8, 3, 2, 1, 77};
  std::string reason;
  EXPECT_EQ(decode_image(tga, "LEAF.TGA", reason).rgba, (Bytes{1, 2, 3, 77})) << reason;
  EXPECT_TRUE(decode_image(tga, "leaf", reason).empty());
}

TEST(Images, OfTgaHaveAllTheirPixelsAndNoOtherFormat) {
  const auto reason_of = [](const Bytes& bytes) {
    std::string reason;
    EXPECT_TRUE(decode_image(bytes, "leaf.tga", reason).empty());
    return reason;
  };
  // One of two pixels is missing; then, after a run of 128, one of 129.
  const std::string unknown = reason_of({});
  EXPECT_EQ(reason_of({0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 32, 8, 3, 2, 1, 7}),
            unknown);
  EXPECT_EQ(reason_of({0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 129, 0, 1, 0, 32, 8, 255, 3, 2, 1, 7}),
            unknown);
  const std::string pnm = "P6 1 1 255\nrgbrgbrgbrgbrgb";
  EXPECT_EQ(reason_of(Bytes(pnm.begin(), pnm.end())), unknown);
}

/// 8 x 8 grey pixels of one value; each of the two tables has one code.
Bytes jpeg() {
  Bytes bytes{0xFF, 0xD8, 0xFF, 0xDB, 0, 67, 0};
  bytes.insert(bytes.end(), 64, 1);
  const Bytes rest{0xFF, 0xC0, 0, 11, 8,    0, 8, 0, 8,  1, 1,    0x11, 0,  // frame
                   0xFF, 0xC4, 0, 20, 0,    1, 0, 0, 0,  0, 0,    0,    0,  // codes
                   0,    0,    0, 0,  0,    0, 0, 0, 0,                     //
                   0xFF, 0xC4, 0, 20, 0x10, 1, 0, 0, 0,  0, 0,    0,    0,  // codes
                   0,    0,    0, 0,  0,    0, 0, 0, 0,                     //
                   0xFF, 0xDA, 0, 8,  1,    1, 0, 0, 63, 0, 0x3F,           // scan
                   0xFF, 0xD9};
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  return bytes;
}

TEST(Images, OfJpegHaveSoundTables) {
  constexpr std::size_t kQuantisation = 2, kFrame = 71, kCodes = 84, kOtherCodes = 106;
  const auto is_read = [](const Bytes& bytes) {
    std::string reason;
    const bool read = !decode_image(bytes, "leaf.jpg", reason).empty();
    EXPECT_EQ(reason, read ? "" : "its JPEG data is damaged");
    return read;
  };
  EXPECT_TRUE(is_read(jpeg()));
  Bytes padded = jpeg();
  padded.insert(padded.begin() + kFrame, {0, 0, 0xFF, 0xFF, 0xFE, 0, 4, 0xFF, 0xC4, 0xFF});
  EXPECT_TRUE(is_read(padded));  // the comment looks like a table
  for (const std::size_t table : {kCodes, kOtherCodes}) {
    Bytes more = jpeg();
    more[table + 12] = more[table + 13] = 200;  // 401 codes
    EXPECT_FALSE(is_read(more));
    Bytes none = jpeg();
    none.erase(none.begin() + table, none.begin() + table + 22);
    EXPECT_FALSE(is_read(none));
  }
  Bytes unquantised = jpeg();
  unquantised.erase(unquantised.begin() + kQuantisation, unquantised.begin() + kFrame);
  EXPECT_FALSE(is_read(unquantised));
  Bytes late = jpeg();  // a table for a second scan
  late.insert(late.end() - 2, {0xFF, 0xC4, 0, 20, 0, 200, 200});
  EXPECT_FALSE(is_read(late));
}

Bytes bmp(std::int32_t width, std::int32_t height) {
  Bytes bytes{'B', 'M', 0, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40, 0, 0, 0};
  for (const std::int32_t side : {width, height}) {
    const Bytes number = bytes_of(std::vector<std::int32_t>{side});
    bytes.insert(bytes.end(), number.begin(), number.end());
  }
  bytes.insert(bytes.end(), {1, 0, 24, 0});
  bytes.resize(54);
  bytes.insert(bytes.end(), {3, 2, 1, 0});
  return bytes;
}

TEST(Images, OfBmpMayBeginAtTheTopButNotBeEmptyOrHuge) {
  const auto reason_of = [](const Bytes& bytes) {
    std::string reason;
    EXPECT_TRUE(decode_image(bytes, "leaf.bmp", reason).empty());
    return reason;
  };
  std::string reason;
  for (const int height : {1, -1}) {
    const Image image = decode_image(bmp(1, height), "leaf.bmp", reason);
    EXPECT_EQ(image.rgba, (Bytes{1, 2, 3, 255})) << reason;
    EXPECT_EQ(image.height, 1);
  }
  EXPECT_EQ(reason_of(bmp(7, 0)), "it has no pixels");
  EXPECT_EQ(reason_of(bmp(16384, -32768)), "it is larger than 8192 x 8192 pixels");
  EXPECT_EQ(reason_of(bmp(1, std::numeric_limits<std::int32_t>::min())),
            "it is larger than 8192 x 8192 pixels");
  EXPECT_EQ(reason_of(bmp(8192, -8192)), "it is cut off");
}

TEST(Images, TellWhereMostIsMissing) {
  Bytes large = jpeg();
  large[71 + 5] = large[71 + 7] = 0x10;  // 4104 x 4104
  std::string reason;
  EXPECT_TRUE(decode_image(large, "leaf.jpg", reason).empty());
  EXPECT_EQ(reason, "it is cut off");
}

TEST(Images, OfPngHaveWholeChunks) {
  const Bytes whole = png(2, 2, kPixels);
  const auto reason_of = [](const Bytes& bytes) {
    std::string reason;
    decode_image(bytes, "leaf.png", reason);
    return reason;
  };
  EXPECT_EQ(reason_of(whole), "");
  Bytes huge = whole;
  huge[33] = 0x7F;  // makes the length of IDAT 2 GiB
  EXPECT_EQ(reason_of(huge), "it is cut off");
  for (std::size_t length = 4; length < whole.size(); ++length) {
    EXPECT_EQ(reason_of(Bytes(whole.begin(), whole.begin() + length)), "it is cut off");
  }
}

TEST(Images, OfManyKindsAreRead) {
  std::size_t count = 0;
  const auto folder = std::filesystem::path(LEAFHULL_TEST_DATA).parent_path() / "fuzz/corpus/image";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::string reason;
    const std::string name = entry.path().filename().string();
    EXPECT_FALSE(decode_image(read_file(entry.path()), name, reason).empty()) << name << reason;
    ++count;
  }
  EXPECT_GT(count, 15u);
}

TEST(Images, OpacityGoesIntoAlpha) {
  const Image colour{1, 1, {9, 8, 7, 255}};
  const Image grey{2, 1, {255, 255, 255, 255, 40, 40, 40, 255}};
  EXPECT_EQ(with_opacity(colour, grey).rgba, (Bytes{9, 8, 7, 255, 9, 8, 7, 40}));
  const Image alpha{2, 1, {255, 255, 255, 3, 0, 0, 0, 200}};
  EXPECT_EQ(with_opacity(colour, alpha).rgba, (Bytes{9, 8, 7, 3, 9, 8, 7, 200}));
  EXPECT_EQ(with_opacity({}, grey).rgba, (Bytes{255, 255, 255, 255, 255, 255, 255, 40}));
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
  // The turn looks counter-clockwise with v down: (1, 0) goes to (0, -1), (0, 1) to (1, 0).
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
