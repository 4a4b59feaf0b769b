// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include "khronos_validator.h"
#include "leafhull/error.h"
#include "leafhull/version.h"
#include "load_glb.h"
#include "output/writers.h"
#include "output_sample.h"

namespace leafhull::test {
namespace {

tinygltf::Model glb_of(const Mesh& mesh) {
  return load_glb(written([&](std::ostream& stream) { write_glb(mesh, stream); }));
}

template <class Element>
std::vector<Element> elements(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = model.accessors.at(static_cast<std::size_t>(index));
  const tinygltf::BufferView& view =
      model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  const std::size_t values =
      accessor.count * static_cast<std::size_t>(tinygltf::GetNumComponentsInType(
                           static_cast<std::uint32_t>(accessor.type)));
  const std::size_t bytes = values * static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(
                                         static_cast<std::uint32_t>(accessor.componentType)));
  EXPECT_EQ(view.byteLength, bytes);
  std::vector<Element> result(bytes / sizeof(Element));
  std::memcpy(result.data(), model.buffers.at(0).data.data() + view.byteOffset, bytes);
  return result;
}

void expect_mesh(const tinygltf::Model& model, const Mesh& mesh) {
  ASSERT_EQ(model.meshes.size(), 1u);
  const tinygltf::Primitive& primitive = model.meshes[0].primitives.at(0);
  EXPECT_EQ(elements<Vec3f>(model, primitive.attributes.at("POSITION")), mesh.positions);
  const auto normals = elements<Vec3f>(model, primitive.attributes.at("NORMAL"));
  ASSERT_EQ(normals.size(), mesh.normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_NEAR(length(Vec3d(normals[i])), 1, 1e-7);
    EXPECT_GT(dot(normals[i], mesh.normals[i]), 0.9999f);
  }
}

TEST(Glb, HoldsTheMesh) {
  const Mesh mesh = sphere(6);
  const tinygltf::Model model = glb_of(mesh);
  expect_mesh(model, mesh);
  const tinygltf::Primitive& primitive = model.meshes[0].primitives[0];
  const tinygltf::Accessor& indices =
      model.accessors.at(static_cast<std::size_t>(primitive.indices));
  EXPECT_EQ(indices.componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
  std::vector<std::uint16_t> expected;
  for (const auto& triangle : mesh.triangles) {
    for (const auto vertex : triangle) expected.push_back(static_cast<std::uint16_t>(vertex));
  }
  EXPECT_EQ(elements<std::uint16_t>(model, primitive.indices), expected);
  EXPECT_EQ(model.asset.generator, std::string("leafhull ") + kVersion);
}

TEST(Glb, DescribesItsBuffer) {
  const tinygltf::Model model = glb_of(sphere(6));
  const tinygltf::Primitive& primitive = model.meshes[0].primitives[0];
  const auto& position =
      model.accessors[static_cast<std::size_t>(primitive.attributes.at("POSITION"))];
  EXPECT_EQ(position.minValues.at(2), -2);
  EXPECT_EQ(position.maxValues.at(2), 2);
  EXPECT_EQ(model.bufferViews.at(0).target, TINYGLTF_TARGET_ARRAY_BUFFER);
  EXPECT_EQ(model.bufferViews.at(1).target, TINYGLTF_TARGET_ARRAY_BUFFER);
  EXPECT_EQ(model.bufferViews.at(2).target, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
}

TEST(Glb, HasOneMatteSingleSidedMaterial) {
  const tinygltf::Model model = glb_of(sphere(6));
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.meshes[0].primitives[0].material, 0);
  EXPECT_FALSE(model.materials[0].doubleSided);
  const auto& pbr = model.materials[0].pbrMetallicRoughness;
  EXPECT_EQ(pbr.metallicFactor, 0);
  EXPECT_EQ(pbr.roughnessFactor, 1);
  EXPECT_GT(pbr.baseColorFactor.at(1), pbr.baseColorFactor.at(0));
  EXPECT_GT(pbr.baseColorFactor.at(1), pbr.baseColorFactor.at(2));
}

// 16-bit indices end at 65,534: the next value restarts a primitive.
TEST(Glb, TakesWideIndicesOnlyWhereNeeded) {
  const auto type_with = [](std::size_t vertices) {
    Mesh mesh = sphere(4);
    mesh.positions.resize(vertices, {1, 0, 0});
    mesh.normals.resize(vertices, {1, 0, 0});
    mesh.triangles.push_back({0, 1, static_cast<std::uint32_t>(vertices - 1)});
    const tinygltf::Model model = glb_of(mesh);
    const int indices = model.meshes[0].primitives[0].indices;
    const int type = model.accessors[static_cast<std::size_t>(indices)].componentType;
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
      EXPECT_EQ(elements<std::uint32_t>(model, indices).back(), vertices - 1);
    } else {
      EXPECT_EQ(elements<std::uint16_t>(model, indices).back(), vertices - 1);
    }
    return type;
  };
  EXPECT_EQ(type_with(65'535), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
  EXPECT_EQ(type_with(65'536), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
}

TEST(Glb, MovesTheNodeToTheOrigin) {
  EXPECT_TRUE(glb_of(sphere(4)).nodes.at(0).translation.empty());
  const tinygltf::Model model = glb_of(sphere(4, {10'000.1, -0.5, 3}));
  EXPECT_EQ(model.nodes.at(0).translation, (std::vector<double>{10'000.1, -0.5, 3}));
  EXPECT_EQ(model.scenes.at(static_cast<std::size_t>(model.defaultScene)).nodes,
            std::vector<int>{0});
}

TEST(Glb, RefusesANormalWithoutDirection) {
  for (const Vec3f bad : {Vec3f{0, 0, 0}, Vec3f{NAN, 0, 1}, Vec3f{INFINITY, 0, 0}}) {
    Mesh mesh = sphere(4);
    mesh.normals[3] = bad;
    try {
      glb_of(mesh);
      FAIL() << "written";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::internal);
      EXPECT_NE(std::string(error.what()).find("vertex 3"), std::string::npos);
    }
  }
}

TEST(Gltf, IsOneFileWithTheSameMesh) {
  const Mesh mesh = sphere(6, {0, 7, 0});
  const std::string text = written([&](std::ostream& stream) { write_gltf(mesh, stream); });
  tinygltf::Model model;
  std::string error, warning;
  ASSERT_TRUE(tinygltf::TinyGLTF().LoadASCIIFromString(&model, &error, &warning, text.data(),
                                                       static_cast<unsigned>(text.size()), ""))
      << error;
  expect_mesh(model, mesh);
  EXPECT_NE(text.find("\"uri\": \"data:application/octet-stream;base64,"), std::string::npos);
}

TEST(Gltf, PassesTheKhronosValidator) {
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> files;
  const auto add = [&](const char* name, void (*write)(const Mesh&, std::ostream&),
                       const Mesh& mesh) {
    files.push_back(folder / name);
    write_file(files.back(), written([&](std::ostream& stream) { write(mesh, stream); }));
  };
  add("narrow.glb", write_glb, sphere(9));
  add("wide.glb", write_glb, sphere(200));
  add("far.glb", write_glb, sphere(9, {10'000.1, 0, -1e6}));
  add("text.gltf", write_gltf, sphere(9));
  expect_valid_gltf(files, folder / "log");
}

}  // namespace
}  // namespace leafhull::test
