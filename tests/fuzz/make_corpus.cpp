// SPDX-License-Identifier: Apache-2.0
// Writes the seeds of the glTF fuzzer: make_corpus FOLDER
#include <filesystem>
#include <fstream>
#include <string>

#include "compressed_glb.h"
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

void write(const std::filesystem::path& path, const Bytes& bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  write(folder / "textured.glb", textured().glb());
  write(folder / "instanced.glb", instanced().glb());
  write(folder / "sparse_strip.glb", sparse_strip().glb());
  write(folder / "draco.glb", with_draco().glb());
  write(folder / "meshopt.glb", with_meshopt().glb());
  GlbBuilder text = instanced();
  text.json["buffers"] = {
      {{"byteLength", 3}, {"uri", "data:application/octet-stream;base64,AAAA"}}};
  std::ofstream(folder / "text.gltf") << text.json.dump();
}
