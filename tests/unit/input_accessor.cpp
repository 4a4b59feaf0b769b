// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "glb_builder.h"
#include "input/gltf.h"

namespace leafhull::test {
namespace {

/// Reads a triangle whose POSITION is the given accessor.
Primitive read_positions(GlbBuilder& b, int accessor, int uv = -1) {
  nlohmann::json primitive;
  primitive["attributes"]["POSITION"] = accessor;
  if (uv >= 0) primitive["attributes"]["TEXCOORD_0"] = uv;
  b.add_node("n", b.add("meshes", {{"name", "m"}, {"primitives", {primitive}}}));
  return read_gltf(b.glb(), "t.glb", {}).primitives[0];
}

const std::vector<Vec3f> kTriangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(Accessor, ReadsInterleavedElements) {
  GlbBuilder b;
  const std::vector<float> rows{0, 0, 0, .5f, .25f, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  const int view = b.add_view(bytes_of(rows));
  b.json["bufferViews"][0]["byteStride"] = 20;
  const int position = b.add(
      "accessors", {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  const int uv = b.add("accessors", {{"bufferView", view},
                                     {"byteOffset", 12},
                                     {"componentType", 5126},
                                     {"count", 3},
                                     {"type", "VEC2"}});
  const Primitive p = read_positions(b, position, uv);
  EXPECT_EQ(p.positions, kTriangle);
  EXPECT_EQ(p.uvs, (std::vector<Vec2f>{{.5f, .25f}, {1, 0}, {0, 1}}));
}

template <class T>
std::vector<Vec3f> quantized(const std::vector<T>& padded, int component_type, bool normalized) {
  GlbBuilder b;
  const int accessor = b.add_accessor(padded, "VEC3", component_type, 3);
  b.json["bufferViews"][0]["byteStride"] = 4 * sizeof(T);
  b.json["accessors"][0]["normalized"] = normalized;
  b.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  return read_positions(b, accessor).positions;
}

TEST(Accessor, ReadsQuantizedIntegers) {
  using V = std::vector<Vec3f>;
  const std::vector<std::int8_t> i8{-128, 127, 0, 0, 1, 2, 3, 0, -1, -2, -3, 0};
  EXPECT_EQ(quantized(i8, 5120, false), (V{{-128, 127, 0}, {1, 2, 3}, {-1, -2, -3}}));
  EXPECT_EQ(quantized(i8, 5120, true)[0], (Vec3f{-1, 1, 0}));
  const std::vector<std::uint8_t> u8{255, 0, 51, 0, 1, 2, 3, 0, 4, 5, 6, 0};
  EXPECT_EQ(quantized(u8, 5121, false)[0], (Vec3f{255, 0, 51}));
  EXPECT_EQ(quantized(u8, 5121, true)[0], (Vec3f{1, 0, 0.2f}));
  const std::vector<std::int16_t> i16{-32768, 32767, 300, 0, 1, 2, 3, 0, 4, 5, 6, 0};
  EXPECT_EQ(quantized(i16, 5122, false)[0], (Vec3f{-32768, 32767, 300}));
  EXPECT_EQ(quantized(i16, 5122, true)[0].x, -1);
  const std::vector<std::uint16_t> u16{65535, 0, 13107, 0, 1, 2, 3, 0, 4, 5, 6, 0};
  EXPECT_EQ(quantized(u16, 5123, false)[0], (Vec3f{65535, 0, 13107}));
  EXPECT_EQ(quantized(u16, 5123, true)[0], (Vec3f{1, 0, 0.2f}));
}

TEST(Accessor, ReadsIndicesOfEverySize) {
  const auto triangles = [](const auto& indices, int component_type) {
    GlbBuilder b;
    b.add_node("n", b.add_mesh("m", {square()}));
    b.json["meshes"][0]["primitives"][0]["indices"] =
        b.add_accessor(indices, "SCALAR", component_type, indices.size());
    return read_gltf(b.glb(), "t.glb", {}).primitives[0].triangles;
  };
  const std::vector<std::array<std::uint32_t, 3>> expected{{3, 2, 1}, {1, 0, 3}};
  EXPECT_EQ(triangles(std::vector<std::uint8_t>{3, 2, 1, 1, 0, 3}, 5121), expected);
  EXPECT_EQ(triangles(std::vector<std::uint16_t>{3, 2, 1, 1, 0, 3}, 5123), expected);
  EXPECT_EQ(triangles(std::vector<std::uint32_t>{3, 2, 1, 1, 0, 3}, 5125), expected);
}

TEST(Accessor, PutsSparseValuesIn) {
  for (const bool has_base : {true, false}) {
    GlbBuilder b;
    const int accessor = b.add_accessor(kTriangle);
    const int indices = b.add_view(bytes_of(std::vector<std::uint16_t>{0, 2}));
    const int values = b.add_view(bytes_of(std::vector<Vec3f>{{7, 8, 9}, {4, 5, 6}}));
    b.json["accessors"][0]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    if (!has_base) b.json["accessors"][0].erase("bufferView");
    const Vec3f middle = has_base ? Vec3f(1, 0, 0) : Vec3f(0, 0, 0);
    EXPECT_EQ(read_positions(b, accessor).positions,
              (std::vector<Vec3f>{{7, 8, 9}, middle, {4, 5, 6}}));
  }
}

}  // namespace
}  // namespace leafhull::test
