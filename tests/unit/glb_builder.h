// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "leafhull/vec.h"
#include "png.h"

namespace leafhull::test {

using Bytes = std::vector<std::uint8_t>;

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(values.data());
  return Bytes(data, data + values.size() * sizeof(T));
}

/// The content of a glTF primitive; empty lists are left out.
struct GlbPrimitive {
  std::vector<Vec3f> positions, normals;
  std::vector<Vec2f> uvs;
  std::vector<std::uint32_t> indices;
  int material = -1;
};

/// Builds small glTF files in memory. `json` and `bin` are public, so that a test can spoil them
/// before it asks for the file. Every add_ function returns the index of what it added.
class GlbBuilder {
 public:
  nlohmann::json json = {{"asset", {{"version", "2.0"}}},
                         {"scene", 0},
                         {"scenes", {{{"nodes", nlohmann::json::array()}}}}};
  Bytes bin;

  int add_view(const Bytes& bytes) {
    bin.resize((bin.size() + 3) / 4 * 4);
    const std::size_t offset = bin.size();
    bin.insert(bin.end(), bytes.begin(), bytes.end());
    return add("bufferViews",
               {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
  }

  /// @param type "SCALAR", "VEC3", ...; T is the type of one component or of one element.
  template <class T>
  int add_accessor(const std::vector<T>& values, const std::string& type, int component_type,
                   std::size_t count) {
    return add("accessors", {{"bufferView", add_view(bytes_of(values))},
                             {"componentType", component_type},
                             {"count", count},
                             {"type", type}});
  }
  int add_accessor(const std::vector<Vec3f>& v) { return add_accessor(v, "VEC3", 5126, v.size()); }
  int add_accessor(const std::vector<Vec2f>& v) { return add_accessor(v, "VEC2", 5126, v.size()); }
  int add_accessor(const std::vector<std::uint32_t>& v) {
    return add_accessor(v, "SCALAR", 5125, v.size());
  }

  /// Adds a texture of RGBA pixels; materials refer to it by the index.
  int add_texture(int width, int height, std::span<const std::uint8_t> rgba) {
    const int image = add(
        "images", {{"bufferView", add_view(png(width, height, rgba))}, {"mimeType", "image/png"}});
    return add("textures", {{"source", image}});
  }

  /// @param alpha_mode "OPAQUE", "MASK" or "BLEND"; @param texture base colour, -1: none.
  int add_material(const std::string& name, const std::string& alpha_mode = "OPAQUE",
                   int texture = -1) {
    nlohmann::json material = {{"name", name}, {"alphaMode", alpha_mode}};
    if (texture >= 0) material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = texture;
    return add("materials", material);
  }

  int add_mesh(const std::string& name, const std::vector<GlbPrimitive>& primitives) {
    nlohmann::json list = nlohmann::json::array();
    for (const GlbPrimitive& primitive : primitives) {
      nlohmann::json entry = {{"attributes", {{"POSITION", add_accessor(primitive.positions)}}}};
      if (!primitive.normals.empty())
        entry["attributes"]["NORMAL"] = add_accessor(primitive.normals);
      if (!primitive.uvs.empty()) entry["attributes"]["TEXCOORD_0"] = add_accessor(primitive.uvs);
      if (!primitive.indices.empty()) entry["indices"] = add_accessor(primitive.indices);
      if (primitive.material >= 0) entry["material"] = primitive.material;
      list.push_back(entry);
    }
    return add("meshes", {{"name", name}, {"primitives", list}});
  }

  /// Adds a root node to the scene, with `properties` such as translation, matrix or extensions.
  int add_node(const std::string& name, int mesh,
               const nlohmann::json& properties = nlohmann::json::object()) {
    nlohmann::json node = properties;
    node["name"] = name;
    if (mesh >= 0) node["mesh"] = mesh;
    const int index = add("nodes", node);
    json["scenes"][0]["nodes"].push_back(index);
    return index;
  }

  int add(const std::string& list, const nlohmann::json& entry) {
    json[list].push_back(entry);
    return int(json[list].size()) - 1;
  }

  Bytes glb() const {
    nlohmann::json document = json;
    if (!bin.empty() && !document.contains("buffers"))
      document["buffers"] = {{{"byteLength", bin.size()}}};
    return pack(document.dump(), bin);
  }

  /// Packs any text and binary chunk into a GLB.
  static Bytes pack(std::string text, Bytes binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4);
    Bytes file{'g', 'l', 'T', 'F'};
    const auto put = [&](std::initializer_list<std::size_t> words) {
      for (const std::size_t word : words)
        for (int shift = 0; shift < 32; shift += 8) file.push_back(std::uint8_t(word >> shift));
    };
    put({2, 20 + text.size() + (binary.empty() ? 0 : 8 + binary.size()), text.size(), 0x4E4F534A});
    file.insert(file.end(), text.begin(), text.end());
    if (!binary.empty()) {
      put({binary.size(), 0x004E4942});
      file.insert(file.end(), binary.begin(), binary.end());
    }
    return file;
  }
};

/// A unit square in the plane z = 0, facing +z.
inline GlbPrimitive square(int material = -1) {
  return {.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
          .normals = std::vector<Vec3f>(4, Vec3f(0, 0, 1)),
          .uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}},
          .indices = {0, 1, 2, 0, 2, 3},
          .material = material};
}

}  // namespace leafhull::test
