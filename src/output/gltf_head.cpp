// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "leafhull/error.h"
#include "leafhull/version.h"
#include "output/binary_record.h"
#include "output/leaf_material.h"
#include "output/mesh_head.h"

namespace leafhull {
namespace {

using Json = nlohmann::ordered_json;

// Codes of glTF 2.0.
constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::uint32_t kVersion2 = 2;
constexpr int kFloat = 5126, kUnsignedInt = 5125;
constexpr int kVertices = 34962, kIndices = 34963;

constexpr std::uint64_t kVertexBytes = 6 * sizeof(float),
                        kTriangleBytes = 3 * sizeof(std::uint32_t);

std::uint64_t binary_bytes(const MeshHead& mesh) {
  return mesh.vertices * kVertexBytes + mesh.triangles * kTriangleBytes;
}

Json list(Vec3d v) { return {v.x, v.y, v.z}; }

Json node_of(const MeshHead& mesh) {
  Json node{{"name", kShapeName}, {"mesh", 0}};
  if (mesh.origin != Vec3d{}) node["translation"] = list(mesh.origin);
  return node;
}

Json document(const MeshHead& mesh) {
  const Json positions{{"bufferView", 0},           {"componentType", kFloat},
                       {"count", mesh.vertices},    {"type", "VEC3"},
                       {"min", list(mesh.box.low)}, {"max", list(mesh.box.high)}};
  const Json normals{{"bufferView", 0},
                     {"byteOffset", kVertexBytes / 2},
                     {"componentType", kFloat},
                     {"count", mesh.vertices},
                     {"type", "VEC3"}};
  const Json indices{{"bufferView", 1},
                     {"componentType", kUnsignedInt},
                     {"count", 3 * mesh.triangles},
                     {"type", "SCALAR"}};
  const Json primitive{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}},
                       {"indices", 2},
                       {"material", 0},
                       {"mode", 4}};
  const Json material{
      {"name", kLeafMaterial},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", leaf_base_color(mesh.colour ? *mesh.colour : kLeafGreen)},
        {"metallicFactor", 0.0},
        {"roughnessFactor", 1.0}}}};
  const Json vertex_view{{"buffer", 0},
                         {"byteLength", mesh.vertices * kVertexBytes},
                         {"byteStride", kVertexBytes},
                         {"target", kVertices}};
  const Json index_view{{"buffer", 0},
                        {"byteOffset", mesh.vertices * kVertexBytes},
                        {"byteLength", mesh.triangles * kTriangleBytes},
                        {"target", kIndices}};
  const auto only = [](const Json& element) { return Json::array({element}); };
  return {{"asset", {{"version", "2.0"}, {"generator", std::string("leafhull ") + kVersion}}},
          {"scene", 0},
          {"scenes", only({{"nodes", {0}}})},
          {"nodes", only(node_of(mesh))},
          {"meshes", only({{"name", kShapeName}, {"primitives", only(primitive)}})},
          {"materials", only(material)},
          {"accessors", {positions, normals, indices}},
          {"bufferViews", {vertex_view, index_view}},
          {"buffers", only({{"byteLength", binary_bytes(mesh)}})}};
}

}  // namespace

void write_glb_head(const MeshHead& mesh, std::ostream& stream) {
  std::string json = document(mesh).dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::uint64_t binary = binary_bytes(mesh);
  constexpr std::uint64_t kHeader = 12, kChunkHeader = 8;
  const std::uint64_t bytes = kHeader + kChunkHeader + json.size() + kChunkHeader + binary;
  if (bytes > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::output,
                "the mesh of " + std::to_string(mesh.triangles) +
                    " triangles does not fit into the 4 GiB of a .glb",
                "Write a .ply, or choose larger voxels.");
  }
  const auto size = [](std::uint64_t count) { return static_cast<std::uint32_t>(count); };
  write_record(stream, kMagic, kVersion2, size(bytes));
  write_record(stream, size(json.size()), kJsonChunk);
  stream << json;
  write_record(stream, size(binary), kBinaryChunk);
}

}  // namespace leafhull
