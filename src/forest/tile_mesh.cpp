// SPDX-License-Identifier: Apache-2.0
#include "forest/tile_mesh.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <system_error>

#include "leafhull/error.h"
#include "output/mesh_vertex.h"
#include "runs/read_file.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

constexpr const char* kComputeAgain = "Run it again with --resume to compute the tile again.";

class GlbReader {
 public:
  GlbReader(std::string_view glb, const std::string& where) : where_(where) {
    std::string error, warning;
    const auto* bytes = reinterpret_cast<const unsigned char*>(glb.data());
    need(tinygltf::TinyGLTF().LoadBinaryFromMemory(&model_, &error, &warning, bytes,
                                                   static_cast<unsigned>(glb.size())));
    need(model_.buffers.size() == 1 && model_.nodes.size() == 1 && model_.meshes.size() == 1 &&
         model_.meshes.front().primitives.size() == 1);
  }

  Mesh mesh() const {
    const tinygltf::Primitive& primitive = model_.meshes.front().primitives.front();
    Mesh mesh;
    const std::vector<double>& origin = model_.nodes.front().translation;
    if (origin.size() == 3) mesh.origin = {origin[0], origin[1], origin[2]};
    mesh.colour = colour();
    mesh.positions = elements<Vec3f>(attribute(primitive, "POSITION"));
    mesh.normals = elements<Vec3f>(attribute(primitive, "NORMAL"));
    mesh.triangles = triangles(primitive.indices);
    for (const auto& [a, b, c] : mesh.triangles) need(std::max({a, b, c}) < mesh.positions.size());
    need(mesh.normals.size() == mesh.positions.size());
    return mesh;
  }

 private:
  std::optional<Vec3f> colour() const {
    if (model_.materials.empty()) return std::nullopt;
    const std::vector<double>& factor =
        model_.materials.front().pbrMetallicRoughness.baseColorFactor;
    if (factor.size() != 4) return std::nullopt;
    return Vec3f(Vec3d(factor[0], factor[1], factor[2]));
  }

  using Triangles = std::vector<std::array<std::uint32_t, 3>>;

  void need(bool holds) const {
    if (holds) return;
    throw Error(ErrorCode::input, where_ + " is not a mesh that leafhull wrote", kComputeAgain);
  }

  int attribute(const tinygltf::Primitive& primitive, const char* name) const {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
  }

  template <class Element>
  const Element& at(const std::vector<Element>& all, int index) const {
    need(index >= 0 && static_cast<std::size_t>(index) < all.size());
    return all[static_cast<std::size_t>(index)];
  }

  /// All elements in the accessor's view.
  template <class Element>
  std::vector<Element> elements(int index) const {
    const tinygltf::BufferView& view =
        at(model_.bufferViews, at(model_.accessors, index).bufferView);
    const std::vector<unsigned char>& data = model_.buffers.front().data;
    need(view.byteOffset <= data.size() && view.byteLength <= data.size() - view.byteOffset &&
         view.byteLength % sizeof(Element) == 0);
    std::vector<Element> result(view.byteLength / sizeof(Element));
    std::memcpy(result.data(), data.data() + view.byteOffset, view.byteLength);
    return result;
  }

  Triangles triangles(int index) const {
    if (at(model_.accessors, index).componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
      return elements<std::array<std::uint32_t, 3>>(index);
    }
    Triangles triangles;
    for (const auto [a, b, c] : elements<std::array<std::uint16_t, 3>>(index)) {
      triangles.push_back({a, b, c});
    }
    return triangles;
  }

  tinygltf::Model model_;
  const std::string& where_;
};

/// Which vertices are connected to one of `seeds`. Triangles come brick by brick, so a few passes
/// reach all of a small piece.
std::vector<char> connected(const Mesh& mesh, const std::vector<std::uint32_t>& seeds) {
  std::vector<char> is_connected(mesh.positions.size(), 0);
  for (const std::uint32_t seed : seeds) is_connected[seed] = 1;
  for (bool grows = true; grows;) {
    grows = false;
    for (const auto& [a, b, c] : mesh.triangles) {
      const char any = is_connected[a] | is_connected[b] | is_connected[c];
      const char all = is_connected[a] & is_connected[b] & is_connected[c];
      if (any == all) continue;
      is_connected[a] = is_connected[b] = is_connected[c] = 1;
      grows = true;
    }
  }
  return is_connected;
}

}  // namespace

Mesh read_mesh(std::string_view glb, const std::string& where) {
  return GlbReader(glb, where).mesh();
}

std::string checked_content(const fs::path& file, const FileRecord& record) {
  std::string content = content_of(file);
  if (record_of(content) == record) return content;
  std::error_code ignored;
  fs::remove(file, ignored);
  throw Error(ErrorCode::input, file.string() + " is damaged: its checksum differs", kComputeAgain);
}

void drop_pieces(Mesh& mesh, Seam& seam, std::span<const std::uint32_t> dropped) {
  std::vector<std::uint32_t> seeds;
  for (const std::uint32_t c : dropped) seeds.push_back(seam.components[c].vertex);
  const std::vector<char> goes = connected(mesh, seeds);

  std::vector<std::uint32_t> moved_to(goes.size());
  std::uint32_t kept = 0, own = 0;
  for (std::uint32_t v = 0; v < goes.size(); ++v) {
    if (goes[v] != 0) continue;
    mesh.positions[kept] = mesh.positions[v];
    mesh.normals[kept] = mesh.normals[v];
    if (v < seam.own_vertices) ++own;
    moved_to[v] = kept++;
  }
  mesh.positions.resize(kept);
  mesh.normals.resize(kept);
  std::erase_if(mesh.triangles, [&](const auto& triangle) { return goes[triangle[0]] != 0; });
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& v : triangle) v = moved_to[v];
  }
  seam.own_vertices = own;
  for (auto* vertices : {&seam.borrowed, &seam.lent}) {
    std::erase_if(*vertices, [&](const SeamVertex& v) { return goes[v.vertex] != 0; });
    for (SeamVertex& v : *vertices) v.vertex = moved_to[v.vertex];
  }
}

Box bounds_of(const Mesh& mesh) {
  Box box;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) box.include(world_position(mesh, v));
  return box;
}

}  // namespace leafhull
