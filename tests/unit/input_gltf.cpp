// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>

#include "compressed_glb.h"
#include "glb_builder.h"
#include "input/gltf.h"
#include "leafhull/tree.h"
#include "read_built.h"
#include "temporary_folder.h"

namespace leafhull::test {
namespace {

Vec3d at(const Instance& instance, Vec3f p) {
  const auto row = [&](int i) {
    const auto& r = instance.to_world[std::size_t(i)];
    return r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3];
  };
  return {row(0), row(1), row(2)};
}

void expect_near(Vec3d a, Vec3d b, double tolerance = 1e-12) {
  EXPECT_LE(length(a - b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Gltf, ReadsAPrimitiveAsItIs) {
  GlbBuilder b;
  const int material = b.add_material("Leaf", "BLEND");
  b.add_node("crown", b.add_mesh("leaves", {square(material)}));
  const TreeModel tree = read(b);
  ASSERT_EQ(tree.primitives.size(), 1u);
  const Primitive& p = tree.primitives[0];
  EXPECT_EQ(p.mesh_name, "leaves");
  EXPECT_EQ(p.positions, square().positions);
  EXPECT_EQ(p.normals, square().normals);
  EXPECT_EQ(p.uvs, square().uvs);
  EXPECT_EQ(p.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  ASSERT_EQ(tree.instances.size(), 1u);
  EXPECT_EQ(tree.instances[0].node_name, "crown");
  EXPECT_EQ(tree.instances[0].to_world, kIdentity);
  ASSERT_EQ(tree.materials.size(), 1u);
  EXPECT_EQ(tree.materials[0].name, "Leaf");
  EXPECT_EQ(tree.materials[0].alpha_mode, AlphaMode::blend);
  EXPECT_TRUE(tree.warnings.empty());
}

TEST(Gltf, ReadsColoursOfVertices) {
  const std::vector<std::array<std::uint8_t, 4>> bytes{
      {255, 0, 0, 255}, {0, 255, 0, 0}, {0, 0, 255, 9}, {51, 51, 51, 255}};
  const std::vector<Vec3f> floats{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2f, 0.2f, 0.2f}};
  for (const bool normalized : {true, false}) {
    GlbBuilder b;
    b.add_node("crown", b.add_mesh("leaves", {square()}));
    const int accessor =
        normalized ? b.add_accessor(bytes, "VEC4", 5121, 4) : b.add_accessor(floats);
    if (normalized) b.json["accessors"][accessor]["normalized"] = true;
    b.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = accessor;
    const TreeModel tree = read(b);
    EXPECT_TRUE(tree.warnings.empty());
    ASSERT_EQ(tree.primitives[0].colors.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      expect_near(Vec3d(tree.primitives[0].colors[i]), Vec3d(floats[i]), 1e-6);
    }
  }
}

TEST(Gltf, PassesOverColoursThatAreNone) {
  const std::vector<Vec3f> three{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<Vec3f> odd{{1, 0, 0}, {0, NAN, 0}, {0, 0, 1}, {1, 1, 1}};
  for (const auto& colors : {three, odd}) {
    GlbBuilder b;
    b.add_node("crown", b.add_mesh("leaves", {square()}));
    b.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = b.add_accessor(colors);
    const TreeModel tree = read(b);
    EXPECT_TRUE(tree.primitives[0].colors.empty());
    ASSERT_EQ(tree.warnings.size(), 1u);
    EXPECT_NE(tree.warnings[0].find("COLOR_0"), std::string::npos);
  }
  GlbBuilder b;
  b.add_node("crown", b.add_mesh("leaves", {square()}));
  b.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 99;
  EXPECT_EQ(read(b).warnings.size(), 1u);
}

TEST(Gltf, KnowsWhatNodesHangFromAndTheirLevels) {
  GlbBuilder b;
  const int mesh = b.add_mesh("leaves", {square()});
  b.add_node("Oak", -1);
  b.add_node("LOD0", mesh);
  b.add_node("far", mesh);
  b.json["nodes"][0]["children"] = {1, 2};
  b.json["nodes"][1]["extensions"]["MSFT_lod"]["ids"] = {2, 77};
  b.json["scenes"][0]["nodes"] = {0};
  const TreeModel tree = read(b);
  ASSERT_EQ(tree.nodes.size(), 3u);
  EXPECT_EQ(tree.nodes[1].name, "LOD0");
  EXPECT_EQ(tree.nodes[0].parent, -1);
  EXPECT_EQ(tree.nodes[2].parent, 0);
  EXPECT_EQ(tree.nodes[1].level, 0);
  EXPECT_EQ(tree.nodes[2].level, 1);
  ASSERT_EQ(tree.instances.size(), 2u);
  EXPECT_EQ(tree.instances[0].node, 1);
}

TEST(Gltf, ComposesTransformsInDouble) {
  GlbBuilder b;
  const int mesh = b.add_mesh("leaves", {square()});
  const double half = std::sqrt(0.5);  // a quarter turn about z
  b.add_node("trunk", -1, {{"translation", {1e7, 0, 0}}, {"rotation", {0, 0, half, half}}});
  b.add_node("crown", mesh, {{"translation", {0.125, 0, 0}}, {"scale", {2, 3, 4}}});
  b.json["nodes"][0]["children"] = {1};
  b.json["scenes"][0]["nodes"] = {0};
  const TreeModel tree = read(b);
  ASSERT_EQ(tree.instances.size(), 1u);
  // (1, 1, 0) -> scaled (2, 3, 0) -> moved (2.125, 3, 0) -> turned (-3, 2.125, 0) -> moved.
  expect_near(at(tree.instances[0], {1, 1, 0}), {1e7 - 3, 2.125, 0}, 1e-8);
}

TEST(Gltf, ReadsMatricesByColumns) {
  GlbBuilder b;
  b.add_node("n", b.add_mesh("m", {square()}),
             {{"matrix", {1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 11, 12, 1}}});
  expect_near(at(read(b).instances[0], {1, 0, 0}), {11, 13, 15});
  expect_near(at(read(b).instances[0], {0, 1, 0}), {14, 16, 18});
}

TEST(Gltf, SharesMeshesBetweenNodes) {
  GlbBuilder b;
  const int mesh = b.add_mesh("m", {square(), square()});
  b.add_node("a", mesh);
  b.add_node("b", mesh, {{"translation", {5, 0, 0}}});
  const TreeModel tree = read(b);
  EXPECT_EQ(tree.primitives.size(), 2u);
  ASSERT_EQ(tree.instances.size(), 4u);
  EXPECT_EQ(tree.instances[2].node_name, "b");
  EXPECT_EQ(tree.instances[3].primitive, 1u);
  EXPECT_EQ(tree.instances[3].to_world[0][3], 5);
}

TEST(Gltf, PlacesInstancesWithNormalisedRotations) {
  GlbBuilder b;
  const int mesh = b.add_mesh("m", {square()});
  const int translation = b.add_accessor(std::vector<Vec3f>{{1, 0, 0}, {2, 0, 0}});
  const int rotation =
      b.add_accessor(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 32767, 0}, "VEC4", 5122, 2);
  b.json["accessors"][std::size_t(rotation)]["normalized"] = true;
  const int scale = b.add_accessor(std::vector<Vec3f>{{1, 1, 1}, {2, 2, 2}});
  nlohmann::json node = {{"translation", {0, 0, 9}}};
  node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", translation}, {"ROTATION", rotation}, {"SCALE", scale}};
  b.add_node("copies", mesh, node);
  b.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const TreeModel tree = read(b);
  ASSERT_EQ(tree.instances.size(), 2u);
  expect_near(at(tree.instances[0], {1, 0, 0}), {2, 0, 9});
  expect_near(at(tree.instances[1], {1, 0, 0}), {0, 0, 9});  // x = 2 - 2 after half a turn about z
  EXPECT_EQ(tree.instances[1].node_name, "copies");
}

TEST(Gltf, TakesTheDefaultSceneElseTheFirstElseTheRoots) {
  GlbBuilder b;
  const int mesh = b.add_mesh("m", {square()});
  b.add_node("a", mesh);
  b.add_node("b", mesh);
  b.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  b.json["scene"] = 1;
  EXPECT_EQ(read(b).instances[0].node_name, "b");
  b.json.erase("scene");
  EXPECT_EQ(read(b).instances[0].node_name, "a");
  b.json.erase("scenes");
  b.json["nodes"][0]["children"] = {1};
  const TreeModel tree = read(b);
  ASSERT_EQ(tree.instances.size(), 2u);
  EXPECT_EQ(tree.instances[0].node_name, "a");
}

TEST(Gltf, UnrollsStripsAndFansAndListsWithoutIndices) {
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  const auto triangles = [](int mode, std::vector<std::uint32_t> indices) {
    GlbBuilder b;
    GlbPrimitive p = square();
    p.positions.push_back({2, 2, 0});
    p.positions.push_back({3, 3, 0});
    p.normals.clear();
    p.uvs.clear();
    p.indices = indices;
    b.add_node("n", b.add_mesh("m", {p}));
    b.json["meshes"][0]["primitives"][0]["mode"] = mode;
    return read(b).primitives[0].triangles;
  };
  EXPECT_EQ(triangles(5, {0, 1, 2, 3}), (Triangles{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(triangles(5, {0, 1, 2, 2, 3, 3, 4, 5}), (Triangles{{0, 1, 2}, {3, 5, 4}}));
  EXPECT_EQ(triangles(6, {0, 1, 2, 3}), (Triangles{{1, 2, 0}, {2, 3, 0}}));
  EXPECT_EQ(triangles(4, {}), (Triangles{{0, 1, 2}, {3, 4, 5}}));
}

TEST(Gltf, PassesOverLinesWithAWarning) {
  GlbBuilder b;
  b.add_node("n", b.add_mesh("m", {square(), square()}));
  b.json["meshes"][0]["primitives"][0]["mode"] = 1;
  const TreeModel tree = read(b);
  EXPECT_EQ(tree.primitives.size(), 1u);
  ASSERT_EQ(tree.warnings.size(), 1u);
  EXPECT_NE(tree.warnings[0].find("meshes[0].primitives[0]"), std::string::npos);
}

TEST(Gltf, DropsVerticesThatNoTriangleUses) {
  GlbBuilder b;
  GlbPrimitive p = square();
  p.indices = {1, 2, 3};
  b.add_node("n", b.add_mesh("m", {p}));
  const Primitive read_back = read(b).primitives[0];
  EXPECT_EQ(read_back.positions, (std::vector<Vec3f>{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(read_back.uvs, (std::vector<Vec2f>{{1, 1}, {1, 0}, {0, 0}}));
  EXPECT_EQ(read_back.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
}

TEST(Gltf, DecompressesDraco) {
  GlbBuilder b;
  b.add_node("n", add_draco_mesh(b, "m", square()));
  const Primitive p = read(b).primitives[0];
  ASSERT_EQ(p.positions.size(), 4u);
  ASSERT_EQ(p.triangles.size(), 2u);
  ASSERT_EQ(p.uvs.size(), 4u);
  double area = 0;
  for (const auto& t : p.triangles)
    area +=
        cross(p.positions[t[1]] - p.positions[t[0]], p.positions[t[2]] - p.positions[t[0]]).z / 2;
  EXPECT_NEAR(area, 1, 1e-5);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(p.uvs[i].x, p.positions[i].x, 1e-4);  // u = x, v = 1 - y as in square()
    EXPECT_NEAR(p.uvs[i].y, 1 - p.positions[i].y, 1e-4);
    EXPECT_NEAR(p.normals[i].z, 1, 1e-2);
  }
}

TEST(Gltf, DecompressesMeshoptWithAFallbackBufferThatIsNotThere) {
  GlbBuilder b;
  b.add_node("n", b.add_mesh("m", {square()}));
  compress_with_meshopt(b, square());
  // The uncompressed data must not be read.
  const std::size_t plain = b.json["bufferViews"][0]["byteOffset"];
  std::fill_n(b.bin.begin() + std::ptrdiff_t(plain), 48, std::uint8_t(0xAB));
  const Primitive p = read(b).primitives[0];
  EXPECT_EQ(p.positions, square().positions);
  ASSERT_EQ(p.triangles.size(), 2u);
}

TEST(Gltf, ReadsTextWithDataUriAndExternalBuffer) {
  const TemporaryFolder folder;
  GlbBuilder b;
  b.add_node("n", b.add_mesh("m", {square()}));
  std::ofstream(folder / "my tree.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(b.bin.data()), std::streamsize(b.bin.size()));
  b.json["buffers"] = {{{"byteLength", b.bin.size()}, {"uri", "my%20tree.bin"}}};
  std::ofstream(folder / "external.gltf") << b.json.dump();
  EXPECT_EQ(read_tree(folder / "external.gltf").primitives[0].positions, square().positions);

  // The vertices (0,0,0), (1,0,0), (0,1,0) in base64.
  GlbBuilder text;
  text.json["buffers"] = {{{"byteLength", 36},
                           {"uri",
                            "data:application/octet-stream;base64,"
                            "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}};
  text.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}};
  text.json["accessors"] = {
      {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}};
  nlohmann::json primitive;
  primitive["attributes"]["POSITION"] = 0;
  text.add_node("n", text.add("meshes", {{"primitives", {primitive}}}));
  const std::string dumped = text.json.dump();
  const TreeModel tree = read_gltf(Bytes(dumped.begin(), dumped.end()), "t.gltf", {});
  EXPECT_EQ(tree.primitives[0].positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

}  // namespace
}  // namespace leafhull::test
