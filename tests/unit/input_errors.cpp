// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "compressed_glb.h"
#include "glb_builder.h"
#include "input/gltf.h"
#include "leafhull/error.h"
#include "leafhull/tree.h"
#include "temporary_folder.h"

namespace leafhull::test {
namespace {

using nlohmann::json;

GlbBuilder plain() {
  GlbBuilder b;
  b.add_node("crown", b.add_mesh("leaves", {square()}));
  return b;
}

/// Expects an error of one line that holds `part`, with a remedy.
void expect_error(const std::function<void()>& read, const std::string& part) {
  try {
    read();
    ADD_FAILURE() << "no error with " << part;
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_NE(message.find(part), std::string::npos) << message << " lacks " << part;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_FALSE(error.remedy().empty());
  }
}

void expect_error(const Bytes& bytes, const std::string& part) {
  expect_error([&] { read_gltf(bytes, "t.glb", {}); }, part);
  expect_error([&] { read_gltf(bytes, "t.glb", {}); }, "t.glb: ");
}

struct Spoiled {
  const char* part;  // a part of the message
  std::function<void(GlbBuilder&)> spoil;
};

class Spoil : public testing::TestWithParam<Spoiled> {};

TEST_P(Spoil, IsAnError) {
  GlbBuilder b = plain();
  ASSERT_NO_THROW(read_gltf(b.glb(), "t.glb", {}));
  GetParam().spoil(b);
  expect_error(b.glb(), GetParam().part);
}

json& accessor(GlbBuilder& b, int i) { return b.json["accessors"][std::size_t(i)]; }
json& primitive(GlbBuilder& b) { return b.json["meshes"][0]["primitives"][0]; }

template <class T>
void poke(GlbBuilder& b, int view, std::size_t at, T value) {
  const std::size_t offset = b.json["bufferViews"][std::size_t(view)]["byteOffset"];
  std::memcpy(b.bin.data() + offset + at, &value, sizeof value);
}

// In plain(), accessors and views are 0 POSITION, 1 NORMAL, 2 TEXCOORD_0, 3 indices.
INSTANTIATE_TEST_SUITE_P(
    Gltf, Spoil,
    testing::Values(
        Spoiled{"POSITION (accessors[0]): 5 elements",
                [](auto& b) { accessor(b, 0)["count"] = 5; }},
        Spoiled{"accessors[0]: count is -1", [](auto& b) { accessor(b, 0)["count"] = -1; }},
        Spoiled{"accessors[0]: count is 99999999999",
                [](auto& b) { accessor(b, 0)["count"] = 99999999999; }},
        Spoiled{"accessors[0]: byteOffset is -4",
                [](auto& b) { accessor(b, 0)["byteOffset"] = -4; }},
        Spoiled{"2147483647 elements", [](auto& b) { accessor(b, 3)["count"] = 2147483647; }},
        Spoiled{"outnumber the bytes",
                [](auto& b) {
                  accessor(b, 0).erase("bufferView");
                  accessor(b, 0)["count"] = 2147483646;
                }},
        Spoiled{"do not fit in the", [](auto& b) { accessor(b, 0)["byteOffset"] = 2147483647; }},
        Spoiled{"byteStride 4 is less",
                [](auto& b) { b.json["bufferViews"][0]["byteStride"] = 4; }},
        Spoiled{"bufferViews[0]: 4800 bytes",
                [](auto& b) { b.json["bufferViews"][0]["byteLength"] = 4800; }},
        Spoiled{"bufferViews[0]: 48 bytes from byte 9007199254740992",
                [](auto& b) { b.json["bufferViews"][0]["byteOffset"] = 9007199254740992; }},
        Spoiled{"there is no buffers[3]", [](auto& b) { b.json["bufferViews"][0]["buffer"] = 3; }},
        Spoiled{"there is no bufferViews[99]", [](auto& b) { accessor(b, 0)["bufferView"] = 99; }},
        Spoiled{"there is no accessors[77]",
                [](auto& b) { primitive(b)["attributes"]["POSITION"] = 77; }},
        Spoiled{"has no POSITION", [](auto& b) { primitive(b)["attributes"].erase("POSITION"); }},
        Spoiled{"elements are not VEC3", [](auto& b) { accessor(b, 0)["type"] = "VEC2"; }},
        Spoiled{"elements are not SCALAR", [](auto& b) { accessor(b, 3)["type"] = "VEC2"; }},
        Spoiled{"componentType 5125 is not allowed",
                [](auto& b) { accessor(b, 0)["componentType"] = 5125; }},
        Spoiled{"componentType 5126 is not allowed",
                [](auto& b) { accessor(b, 3)["componentType"] = 5126; }},
        Spoiled{"componentType", [](auto& b) { accessor(b, 0)["componentType"] = 1; }},
        Spoiled{"index 4 is past its 4 vertices", [](auto& b) { poke(b, 3, 8, 4u); }},
        Spoiled{"3 normals for 4 vertices", [](auto& b) { accessor(b, 1)["count"] = 3; }},
        Spoiled{"POSITION of vertex 2 in mesh \"leaves\" is not finite",
                [](auto& b) { poke(b, 0, 28, std::numeric_limits<float>::quiet_NaN()); }},
        Spoiled{"POSITION of vertex 0 in mesh \"leaves\" is not finite",
                [](auto& b) { poke(b, 0, 0, -std::numeric_limits<float>::infinity()); }},
        Spoiled{"not three per triangle", [](auto& b) { accessor(b, 3)["count"] = 5; }},
        Spoiled{"mode 7 is unknown", [](auto& b) { primitive(b)["mode"] = 7; }},
        Spoiled{"there is no materials[5]", [](auto& b) { primitive(b)["material"] = 5; }},
        Spoiled{"there is no meshes[9]", [](auto& b) { b.json["nodes"][0]["mesh"] = 9; }},
        Spoiled{"mesh is \"leaves\"", [](auto& b) { b.json["nodes"][0]["mesh"] = "leaves"; }},
        Spoiled{"nodes[0]: is reached twice", [](auto& b) { b.json["nodes"][0]["children"] = {0}; }},
        Spoiled{"there is no nodes[12]", [](auto& b) { b.json["nodes"][0]["children"] = {12}; }},
        Spoiled{"children is -1", [](auto& b) { b.json["nodes"][0]["children"] = {-1}; }},
        Spoiled{"there is no scenes[4]", [](auto& b) { b.json["scene"] = 4; }},
        Spoiled{"translation is not 3 numbers",
                [](auto& b) { b.json["nodes"][0]["translation"] = {1, 2}; }},
        Spoiled{"matrix is not 16 numbers",
                [](auto& b) { b.json["nodes"][0]["matrix"] = {1, 0, nullptr}; }},
        Spoiled{"transform that is not finite",
                [](auto& b) { b.json["nodes"][0]["rotation"] = {0, 0, 0, 0}; }},
        Spoiled{"nodes[1]: has a transform that is not finite",
                [](auto& b) {
                  b.json["nodes"][0]["scale"] = {1e200, 1, 1};
                  b.json["nodes"][0]["children"] = {1};
                  b.json["nodes"].push_back({{"mesh", 0}, {"scale", {1e200, 1, 1}}});
                }},
        Spoiled{"\"FOO_twist\" is not supported",
                [](auto& b) { b.json["extensionsRequired"] = {"FOO_twist"}; }},
        Spoiled{"glTF version \"1.0\"", [](auto& b) { b.json["asset"]["version"] = "1.0"; }},
        Spoiled{"not a glTF document", [](auto& b) { b.json.erase("asset"); }},
        Spoiled{"meshes: is not a list", [](auto& b) { b.json["meshes"] = 3; }},
        Spoiled{"meshes[0]: is not an object", [](auto& b) { b.json["meshes"] = {3}; }},
        Spoiled{"attributes", [](auto& b) { primitive(b).erase("attributes"); }},
        Spoiled{"nested more than 64 deep",
                [](auto& b) {
                  json deep = json::array();
                  for (int i = 0; i < 1000; ++i) deep = json::array({std::move(deep)});
                  b.json["extras"] = std::move(deep);
                }},
        Spoiled{"buffers[0]: needs 100000 bytes",
                [](auto& b) { b.json["buffers"] = {{{"byteLength", 100000}}}; }},
        Spoiled{"buffers[1]: has neither",
                [](auto& b) { b.json["buffers"] = {{{"byteLength", 4}}, {{"byteLength", 4}}}; }},
        Spoiled{"cannot be decoded",
                [](auto& b) {
                  b.json["buffers"] = {{{"byteLength", 4}, {"uri", "data:what;base64"}}};
                }},
        Spoiled{"holds no triangles", [](auto& b) { b.json["scenes"][0]["nodes"] = json::array(); }},
        Spoiled{"sparse index 4 is past its 4",
                [](auto& b) {
                  const int indices = b.add_view({4});
                  const int values = b.add_view(Bytes(12));
                  accessor(b, 0)["sparse"] = {
                      {"count", 1},
                      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                      {"values", {{"bufferView", values}}}};
                }},
        Spoiled{"more sparse values than elements",
                [](auto& b) {
                  accessor(b, 0)["sparse"] = {
                      {"count", 5},
                      {"indices", {{"bufferView", 3}, {"componentType", 5125}}},
                      {"values", {{"bufferView", 0}}}};
                }}));

TEST(BadInput, DamagedContainers) {
  const Bytes good = plain().glb();
  expect_error(Bytes(good.begin(), good.begin() + 15), "GLB header: is cut off");
  expect_error(Bytes(good.begin(), good.end() - 10), "GLB header: says");
  Bytes longer = good;
  longer[12] = 0xFF;  // the length of the JSON chunk
  longer[14] = 0xFF;
  expect_error(longer, "GLB chunk 0: says");
  Bytes old = good;
  old[4] = 1;
  expect_error(old, "version 1 is not read");
  Bytes not_json = good;
  not_json[16] = 'X';
  expect_error(not_json, "GLB chunk 0: is not JSON");
  expect_error(GlbBuilder::pack("{\"asset\":{\"version\":\"2.0\"", {}), "JSON: ");
  expect_error(GlbBuilder::pack("{\"a\":1e999}", {}), "JSON: ");
  expect_error(GlbBuilder::pack("", {}), "JSON: ");
}

TEST(BadInput, DeepNodeChainsAreRead) {
  GlbBuilder b = plain();
  for (int i = 0; i < 100000; ++i) b.json["nodes"].push_back({{"children", {i}}});
  b.json["scenes"][0]["nodes"] = {100000};
  EXPECT_EQ(read_gltf(b.glb(), "t.glb", {}).instances.size(), 1u);
}

TEST(BadInput, DamagedCompression) {
  GlbBuilder draco;
  draco.add_node("n", add_draco_mesh(draco, "m", square()));
  GlbBuilder cut = draco;
  cut.json["bufferViews"][0]["byteLength"] = 20;
  expect_error(cut.glb(), "KHR_draco_mesh_compression");
  GlbBuilder wrong_id = draco;
  wrong_id.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]
               ["attributes"]["POSITION"] = 42;
  expect_error(wrong_id.glb(), "attribute 42 is missing");

  GlbBuilder meshopt = plain();
  compress_with_meshopt(meshopt, square());
  const auto spoil = [&](const char* key, const json& value, const std::string& part) {
    GlbBuilder b = meshopt;
    b.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
    expect_error(b.glb(), part);
  };
  spoil("count", 2147483647, "byteLength is too small");
  spoil("byteStride", 3, "byteStride is not 4, 8");
  spoil("mode", "NEWER", "unknown mode");
  spoil("filter", "NEWER", "unknown filter");
  spoil("filter", "QUATERNION", "byteStride is not 8");
  spoil("byteLength", 7, "cannot be decoded");
  spoil("buffer", 8, "there is no buffers[8]");
  spoil("byteOffset", 1000000, "do not fit");
}

TEST(BadInput, HarmlessRequiredExtensionsAreAccepted) {
  GlbBuilder b = plain();
  b.json["extensionsRequired"] = {"KHR_materials_unlit", "KHR_lights_punctual",
                                  "KHR_texture_basisu", "KHR_mesh_quantization"};
  EXPECT_NO_THROW(read_gltf(b.glb(), "t.glb", {}));
}

TEST(BadInput, NormalsThatAreNotFiniteAreKept) {
  GlbBuilder b = plain();
  poke(b, 1, 4, std::numeric_limits<float>::quiet_NaN());
  const TreeModel tree = read_gltf(b.glb(), "t.glb", {});
  ASSERT_EQ(tree.primitives[0].normals.size(), 4u);
  EXPECT_TRUE(std::isnan(tree.primitives[0].normals[0].y));
  EXPECT_EQ(tree.primitives[0].normals[1].z, 1);
  ASSERT_EQ(tree.warnings.size(), 1u);
  EXPECT_NE(tree.warnings[0].find("normals"), std::string::npos);
}

TEST(BadInput, WhatMayNeverEndIsNotRead) {
  expect_error([] { read_tree("/dev/zero"); }, "/dev/zero: cannot be read: it is not a regular");
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  GlbBuilder b = plain();
  for (const std::string uri : {"pipe", "/dev/zero"}) {
    b.json["buffers"] = {{{"byteLength", 4}, {"uri", uri}}};
    expect_error([&] { read_gltf(b.glb(), "t.glb", Companions(folder / "t.glb", true)); },
                 "it is not a regular file");
  }
}

TEST(BadInput, TexturesWithoutAnImageWarn) {
  const auto warning = [](const json& texture) {
    GlbBuilder b = plain();
    b.json["images"] = {json::object()};
    b.json["textures"] = {texture};
    b.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    primitive(b)["material"] = 0;
    const TreeModel tree = read_gltf(b.glb(), "t.glb", {});
    return tree.warnings.size() == 1 ? tree.warnings[0] : "not one warning";
  };
  EXPECT_EQ(warning(json::object()), "textures[0]: texture not read: it names no image");
  EXPECT_EQ(warning({{"source", 0}}),
            "images[0]: texture not read: it has neither a uri nor a bufferView");
}

TEST(BadInput, FilesThatAreNotTrees) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
  };
  const auto reading = [](const std::filesystem::path& path) {
    return [path] { read_tree(path); };
  };
  expect_error(reading(folder / "none.glb"), "none.glb: cannot be read: No such file");
  expect_error(reading(folder.path()), "Is a directory");
  expect_error(reading(write("empty.glb", "")), "is empty");
  expect_error(reading(write("noise.glb", "noise")), "is not a glTF file despite its name");
  expect_error(reading(write("tree.fbx", "Kaydara")), "is not an FBX file despite its name");
  expect_error(reading(write("tree.txt", "a tree")), "is not a glTF, FBX or OBJ file");
  expect_error(reading(write("package.gltf", "{\"name\": 1}")), "not a glTF document");
  expect_error(reading(write("lost.gltf",
                             R"({"asset":{"version":"2.0"},
                                 "buffers":[{"byteLength":4,"uri":"lost%20.bin"}]})")),
               "lost .bin\" cannot be read: No such file");
}

TEST(BadInput, FilesWithoutPermission) {
  if (geteuid() == 0) GTEST_SKIP() << "SKIPPED: root may read every file";
  const TemporaryFolder folder;
  std::ofstream(folder / "secret.glb") << "glTF";
  std::filesystem::permissions(folder / "secret.glb", std::filesystem::perms::none);
  expect_error([&] { read_tree(folder / "secret.glb"); }, "Permission denied");
}

}  // namespace
}  // namespace leafhull::test
