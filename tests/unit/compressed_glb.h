// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <string>
#include <vector>

#include "glb_builder.h"

namespace leafhull::test {

/// Adds a mesh with one primitive in KHR_draco_mesh_compression, whose accessors have no data.
inline int add_draco_mesh(GlbBuilder& builder, const std::string& name,
                          const GlbPrimitive& primitive) {
  draco::TriangleSoupMeshBuilder soup;
  soup.Start(int(primitive.indices.size() / 3));
  const auto add = [&](draco::GeometryAttribute::Type type, int components, const auto& values) {
    const int id = soup.AddAttribute(type, std::int8_t(components), draco::DT_FLOAT32);
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3)
      soup.SetAttributeValuesForFace(
          id, draco::FaceIndex(std::uint32_t(i / 3)), &values[primitive.indices[i]],
          &values[primitive.indices[i + 1]], &values[primitive.indices[i + 2]]);
    return id;
  };
  add(draco::GeometryAttribute::POSITION, 3, primitive.positions);
  add(draco::GeometryAttribute::NORMAL, 3, primitive.normals);
  add(draco::GeometryAttribute::TEX_COORD, 2, primitive.uvs);
  const auto mesh = soup.Finalize();
  const auto id = [&](draco::GeometryAttribute::Type type) {
    return mesh->GetNamedAttribute(type)->unique_id();
  };
  draco::EncoderBuffer buffer;
  draco::Encoder encoder;
  if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) throw std::runtime_error("draco encoder");
  const int view = builder.add_view(Bytes(buffer.data(), buffer.data() + buffer.size()));

  const auto accessor = [&](const char* type, int component_type, std::size_t count) {
    return builder.add("accessors",
                       {{"componentType", component_type}, {"count", count}, {"type", type}});
  };
  const std::size_t count = mesh->num_points();
  nlohmann::json entry = {{"attributes",
                           {{"POSITION", accessor("VEC3", 5126, count)},
                            {"NORMAL", accessor("VEC3", 5126, count)},
                            {"TEXCOORD_0", accessor("VEC2", 5126, count)}}},
                          {"indices", accessor("SCALAR", 5125, primitive.indices.size())}};
  entry["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view},
      {"attributes",
       {{"POSITION", id(draco::GeometryAttribute::POSITION)},
        {"NORMAL", id(draco::GeometryAttribute::NORMAL)},
        {"TEXCOORD_0", id(draco::GeometryAttribute::TEX_COORD)}}}};
  builder.json["extensionsRequired"].push_back("KHR_draco_mesh_compression");
  builder.json["extensionsUsed"].push_back("KHR_draco_mesh_compression");
  return builder.add("meshes", {{"name", name}, {"primitives", {entry}}});
}

/// Compresses the positions and indices of an existing mesh as gltfpack does: the views keep an
/// empty fallback buffer.
inline void compress_with_meshopt(GlbBuilder& builder, const GlbPrimitive& primitive) {
  const auto compress = [&](int view, Bytes data, std::size_t count, std::size_t stride,
                            const char* mode) {
    const nlohmann::json described = builder.json["bufferViews"][std::size_t(view)];
    const int added = builder.add_view(data);
    const nlohmann::json where = builder.json["bufferViews"][std::size_t(added)];
    builder.json["bufferViews"].erase(std::size_t(added));
    nlohmann::json compressed = {{"buffer", 1},
                                 {"byteOffset", described["byteOffset"]},
                                 {"byteLength", described["byteLength"]}};
    compressed["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                           {"byteOffset", where["byteOffset"]},
                                                           {"byteLength", where["byteLength"]},
                                                           {"byteStride", stride},
                                                           {"count", count},
                                                           {"mode", mode}};
    builder.json["bufferViews"][std::size_t(view)] = compressed;
  };
  const nlohmann::json entry = builder.json["meshes"][0]["primitives"][0];
  const auto view_of = [&](const nlohmann::json& accessor) {
    return builder.json["accessors"][accessor.get<std::size_t>()]["bufferView"].get<int>();
  };

  const std::size_t vertices = primitive.positions.size(), indices = primitive.indices.size();
  Bytes packed(meshopt_encodeVertexBufferBound(vertices, sizeof(Vec3f)));
  packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), primitive.positions.data(),
                                           vertices, sizeof(Vec3f)));
  compress(view_of(entry["attributes"]["POSITION"]), packed, vertices, sizeof(Vec3f), "ATTRIBUTES");
  packed.resize(meshopt_encodeIndexBufferBound(indices, vertices));
  packed.resize(
      meshopt_encodeIndexBuffer(packed.data(), packed.size(), primitive.indices.data(), indices));
  compress(view_of(entry["indices"]), packed, indices, 4, "TRIANGLES");

  nlohmann::json fallback = {{"byteLength", builder.bin.size()}};
  fallback["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
  builder.json["buffers"] = {{{"byteLength", builder.bin.size()}}, fallback};
  builder.json["extensionsRequired"].push_back("EXT_meshopt_compression");
  builder.json["extensionsUsed"].push_back("EXT_meshopt_compression");
}

}  // namespace leafhull::test
