// SPDX-License-Identifier: Apache-2.0
// make_corpus tests/fuzz/corpus writes the glTF and FBX seeds that code builds. compressed.fbx is
// skinned_binary.fbx with its arrays deflated.
#include <filesystem>
#include <fstream>
#include <string>

#include "compressed_glb.h"
#include "fbx_builder.h"
#include "glb_builder.h"

namespace {

using namespace leafhull::test;
using leafhull::Vec3f;

GlbBuilder textured() {
  GlbBuilder b;
  const Bytes pixels{0, 255, 0, 255, 0, 255, 0, 0};
  b.add("samplers", {{"wrapS", 33071}});
  const int texture = b.add_texture(2, 1, pixels);
  b.json["textures"][0]["sampler"] = 0;
  const int material = b.add_material("leaf", "MASK", texture);
  b.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = {
      {"KHR_texture_transform", {{"offset", {0.5, 0}}, {"rotation", 1}, {"scale", {2, 2}}}}};
  b.add_node("crown", b.add_mesh("leaves", {square(material)}),
             {{"translation", {1, 2, 3}}, {"rotation", {0, 0, 0, 1}}, {"scale", {2, 2, 2}}});
  return b;
}

GlbBuilder instanced() {
  GlbBuilder b;
  const int mesh = b.add_mesh("leaves", {square()});
  const int translation = b.add_accessor(std::vector<Vec3f>{{1, 0, 0}, {2, 0, 0}});
  const int rotation =
      b.add_accessor(std::vector<std::int8_t>{0, 0, 0, 127, 127, 0, 0, 0}, "VEC4", 5120, 2);
  b.json["accessors"][std::size_t(rotation)]["normalized"] = true;
  nlohmann::json node;
  node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", translation},
                                                                 {"ROTATION", rotation}};
  b.add_node("copies", mesh, node);
  return b;
}

GlbBuilder sparse_strip() {
  GlbBuilder b;
  const int mesh = b.add_mesh("leaves", {square()});
  nlohmann::json& primitive = b.json["meshes"][0]["primitives"][0];
  primitive["mode"] = 5;
  primitive.erase("indices");
  const int indices = b.add_view({1});
  const int values = b.add_view(bytes_of(std::vector<Vec3f>{{3, 0, 0}}));
  b.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
      {"values", {{"bufferView", values}}}};
  b.add_node("strip", mesh, {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}});
  return b;
}

GlbBuilder with_draco() {
  GlbBuilder b;
  b.add_node("crown", add_draco_mesh(b, "leaves", square()));
  return b;
}

GlbBuilder with_meshopt() {
  GlbBuilder b;
  b.add_node("crown", b.add_mesh("leaves", {square()}));
  compress_with_meshopt(b, square());
  return b;
}

constexpr std::int64_t kMesh = 10, kModel = 20, kMaterial = 30, kTexture = 40;

FbxRecord layer(const std::string& kind, const std::string& values, std::vector<double> data,
                const std::string& mapping = "ByPolygonVertex") {
  return {"LayerElement" + kind,
          {0},
          {{"Name", {std::string("first")}},
           {"MappingInformationType", {mapping}},
           {"ReferenceInformationType", {std::string("Direct")}},
           {values, {std::move(data)}}}};
}

/// One quad under a node.
FbxBuilder fbx_square() {
  FbxBuilder file;
  file.settings = {property("UpAxis", "int", {2}), property("UnitScaleFactor", "double", {100})};
  file.object(kMesh, "Geometry", "Square", "Mesh",
              {{"Vertices", {std::vector<double>{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}}},
               {"PolygonVertexIndex", {std::vector<std::int32_t>{0, 1, 2, -4}}},
               layer("UV", "UV", {0, 0, 1, 0, 1, 1, 0, 1}),
               layer("Normal", "Normals", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})});
  file.object(kModel, "Model", "Leaf", "Mesh",
              {properties({property("Lcl Rotation", "Lcl Rotation", {10, 20, 30}),
                           property("GeometricTranslation", "Vector3D", {1, 2, 3})})});
  file.connect(kModel, 0);
  file.connect(kMesh, kModel);
  return file;
}

/// The quad with an embedded PNG.
FbxBuilder fbx_textured() {
  FbxBuilder file = fbx_square();
  const Bytes pixels = png(2, 1, Bytes{0, 255, 0, 255, 0, 255, 0, 0});
  file.object(kMaterial, "Material", "leaf", "",
              {{"ShadingModel", {std::string("phong")}},
               properties({property("DiffuseColor", "Color", {0.2, 0.8, 0.2}),
                           property("Opacity", "double", {0.5})})});
  file.object(kTexture, "Texture", "map", "", {{"RelativeFilename", {std::string("a.png")}}});
  file.object(kTexture + 1, "Video", "clip", "Clip",
              {{"RelativeFilename", {std::string("a.png")}},
               {"Content", {std::string(pixels.begin(), pixels.end())}}});
  file.connect(kMaterial, kModel);
  file.connect(kTexture, kMaterial, "DiffuseColor");
  file.connect(kTexture + 1, kTexture);
  return file;
}

/// The quad with colours, posed by a joint, beside a group of levels.
FbxBuilder fbx_skinned() {
  FbxBuilder file = fbx_square();
  file.objects[0].children.push_back(
      layer("Color", "Colors", {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 0.5, 0, 0, 1}));
  file.objects[0].children.push_back({"LayerElementMaterial",
                                      {0},
                                      {{"MappingInformationType", {std::string("AllSame")}},
                                       {"ReferenceInformationType", {std::string("IndexToDirect")}},
                                       {"Materials", {std::vector<std::int32_t>{0}}}}});
  file.object(63, "NodeAttribute", "Bone", "LimbNode");
  file.object(60, "Model", "Bone", "LimbNode",
              {properties({property("Lcl Translation", "Lcl Translation", {0, 0, 4})})});
  file.object(61, "Deformer", "Skin", "Skin");
  const std::vector<double> identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  file.object(62, "Deformer", "Cluster", "Cluster",
              {{"Indexes", {std::vector<std::int32_t>{0, 1, 2, 3}}},
               {"Weights", {std::vector<double>{1, 0.5, 1, 1}}},
               {"Transform", {identity}},
               {"TransformLink", {identity}}});
  file.object(51, "NodeAttribute", "Lods", "LodGroup");
  file.object(50, "Model", "Lods", "LodGroup");
  file.object(70, "Model", "Coarse", "Mesh",
              {properties({property("Visibility", "Visibility", {0})})});
  file.connect(60, 0);
  file.connect(63, 60);
  file.connect(61, kMesh);
  file.connect(62, 61);
  file.connect(60, 62);
  file.connect(50, 0);
  file.connect(51, 50);
  file.connect(70, 50);
  file.connect(kMesh, 70);
  return file;
}

void write(const std::filesystem::path& path, const Bytes& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path corpus = arguments[1], folder = corpus / "gltf";
  write(folder / "textured.glb", textured().glb());
  write(folder / "instanced.glb", instanced().glb());
  write(folder / "sparse_strip.glb", sparse_strip().glb());
  write(folder / "draco.glb", with_draco().glb());
  write(folder / "meshopt.glb", with_meshopt().glb());
  GlbBuilder text = instanced();
  text.json["buffers"] = {
      {{"byteLength", 3}, {"uri", "data:application/octet-stream;base64,AAAA"}}};
  std::ofstream(folder / "text.gltf") << text.json.dump();

  std::ofstream(corpus / "fbx/square.fbx") << fbx_square().ascii();
  std::ofstream(corpus / "fbx/square_binary.fbx") << fbx_square().binary();
  std::ofstream(corpus / "fbx/textured_binary.fbx") << fbx_textured().binary();
  std::ofstream(corpus / "fbx/skinned.fbx") << fbx_skinned().ascii();
  std::ofstream(corpus / "fbx/skinned_binary.fbx") << fbx_skinned().binary();
}
