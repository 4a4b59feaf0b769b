// SPDX-License-Identifier: Apache-2.0
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "leafhull/error.h"
#include "leafhull/version.h"
#include "output/leaf_material.h"
#include "output/mesh_vertex.h"
#include "output/writers.h"

namespace leafhull {
namespace {

/// Appends `elements` to the file's only buffer, as a buffer view and an accessor over all of it.
template <class Element>
int add_accessor(tinygltf::Model& model, const std::vector<Element>& elements, int target,
                 int component_type, int type) {
  const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type));
  std::vector<unsigned char>& data = model.buffers.front().data;

  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = elements.size() * sizeof(Element);
  view.target = target;
  const auto* bytes = reinterpret_cast<const unsigned char*>(elements.data());
  data.insert(data.end(), bytes, bytes + view.byteLength);
  data.resize((data.size() + 3) / 4 * 4);  // accessors are aligned to their component's size

  tinygltf::Accessor accessor;
  accessor.bufferView = static_cast<int>(model.bufferViews.size());
  accessor.componentType = component_type;
  accessor.type = type;
  accessor.count = view.byteLength / static_cast<std::size_t>(components) /
                   static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(
                       static_cast<std::uint32_t>(component_type)));
  model.bufferViews.push_back(std::move(view));
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

int add_positions(tinygltf::Model& model, const Mesh& mesh) {
  const int index = add_accessor(model, mesh.positions, TINYGLTF_TARGET_ARRAY_BUFFER,
                                 TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
  Box box;
  for (const Vec3f& position : mesh.positions) box.include(Vec3d(position));
  model.accessors.back().minValues = {box.low.x, box.low.y, box.low.z};
  model.accessors.back().maxValues = {box.high.x, box.high.y, box.high.z};
  return index;
}

std::vector<Vec3f> unit_normals(const Mesh& mesh) {
  std::vector<Vec3f> normals(mesh.normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = unit_normal(mesh, i);
  return normals;
}

int add_normals(tinygltf::Model& model, const std::vector<Vec3f>& normals) {
  return add_accessor(model, normals, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_FLOAT,
                      TINYGLTF_TYPE_VEC3);
}

int add_indices(tinygltf::Model& model, const Mesh& mesh) {
  // The largest 16-bit value restarts a primitive and so names no vertex.
  if (mesh.positions.size() > std::numeric_limits<std::uint16_t>::max()) {
    return add_accessor(model, mesh.triangles, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                        TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
  }
  std::vector<std::array<std::uint16_t, 3>> triangles(mesh.triangles.size());
  std::ranges::transform(mesh.triangles, triangles.begin(), [](const auto& triangle) {
    return std::array{static_cast<std::uint16_t>(triangle[0]),
                      static_cast<std::uint16_t>(triangle[1]),
                      static_cast<std::uint16_t>(triangle[2])};
  });
  return add_accessor(model, triangles, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                      TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR);
}

tinygltf::Material leaf_material() {
  tinygltf::Material material;
  material.name = kLeafMaterial;
  material.pbrMetallicRoughness.baseColorFactor.assign(kLeafColour.begin(), kLeafColour.end());
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = 1;
  return material;
}

/// @throws Error output where the sizes in a GLB, 32 bits each, cannot tell the mesh's size.
void check_size(const Mesh& mesh) {
  constexpr std::size_t kRoomForJson = 1 << 16;
  const std::size_t bytes = mesh.positions.size() * sizeof(Vec3f) +
                            mesh.normals.size() * sizeof(Vec3f) +
                            mesh.triangles.size() * sizeof(mesh.triangles[0]);
  if (bytes > std::numeric_limits<std::uint32_t>::max() - kRoomForJson) {
    throw Error(ErrorCode::output,
                "the mesh of " + std::to_string(mesh.triangles.size()) +
                    " triangles does not fit into the 4 GiB of a glTF buffer",
                "Write a .ply, or choose a lower resolution.");
  }
}

tinygltf::Model to_gltf(const Mesh& mesh, const std::vector<Vec3f>& normals) {
  check_size(mesh);
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = std::string("leafhull ") + kVersion;
  model.buffers.emplace_back();
  model.buffers.front().data.reserve(mesh.positions.size() * 2 * sizeof(Vec3f) +
                                     mesh.triangles.size() * sizeof(mesh.triangles[0]));

  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = 0;
  primitive.attributes["POSITION"] = add_positions(model, mesh);
  primitive.attributes["NORMAL"] = add_normals(model, normals);
  primitive.indices = add_indices(model, mesh);
  model.materials.push_back(leaf_material());

  model.meshes.emplace_back();
  model.meshes.front().name = kShapeName;
  model.meshes.front().primitives.push_back(std::move(primitive));

  tinygltf::Node node;
  node.name = kShapeName;
  node.mesh = 0;
  if (mesh.origin != Vec3d{}) {
    node.translation = {mesh.origin.x, mesh.origin.y, mesh.origin.z};
  }
  model.nodes.push_back(std::move(node));

  model.scenes.emplace_back();
  model.scenes.front().nodes = {0};
  model.defaultScene = 0;
  return model;
}

void write_binary(const tinygltf::Model& model, std::ostream& stream) {
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, /*prettyPrint=*/false,
                                              /*writeBinary=*/true);
}

}  // namespace

void write_glb(const Mesh& mesh, std::ostream& stream) {
  write_binary(to_gltf(mesh, unit_normals(mesh)), stream);
}

void write_glb_again(const Mesh& mesh, std::ostream& stream) {
  write_binary(to_gltf(mesh, mesh.normals), stream);
}

void write_gltf(const Mesh& mesh, std::ostream& stream) {
  const tinygltf::Model model = to_gltf(mesh, unit_normals(mesh));
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, /*prettyPrint=*/true,
                                              /*writeBinary=*/false);
}

}  // namespace leafhull
