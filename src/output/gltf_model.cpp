// SPDX-License-Identifier: Apache-2.0
#include "output/gltf_model.h"

#include <algorithm>
#include <array>
#include <limits>

#include "leafhull/version.h"
#include "output/leaf_material.h"
#include "output/mesh_vertex.h"

namespace leafhull {
namespace {

int add_positions(tinygltf::Model& model, const Mesh& mesh) {
  const int index = add_accessor(model, mesh.positions, TINYGLTF_TARGET_ARRAY_BUFFER,
                                 TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
  Box box;
  for (const Vec3f& position : mesh.positions) box.include(Vec3d(position));
  model.accessors.back().minValues = {box.low.x, box.low.y, box.low.z};
  model.accessors.back().maxValues = {box.high.x, box.high.y, box.high.z};
  return index;
}

int add_normals(tinygltf::Model& model, const Mesh& mesh, Normals given) {
  std::vector<Vec3f> normals = mesh.normals;
  if (given == Normals::any_length) {
    for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = unit_normal(mesh, i);
  }
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

/// The file's material of that colour, appended if it is the first.
int material_of(tinygltf::Model& model, const std::optional<Vec3f>& colour) {
  const std::array<double, 4> color = leaf_base_color(colour ? *colour : kLeafGreen);
  const std::vector<double> factor(color.begin(), color.end());
  const auto known = std::ranges::find_if(model.materials, [&](const tinygltf::Material& m) {
    return m.pbrMetallicRoughness.baseColorFactor == factor;
  });
  if (known != model.materials.end()) {
    return static_cast<int>(known - model.materials.begin());
  }
  tinygltf::Material& material = model.materials.emplace_back();
  material.name = kLeafMaterial;
  material.pbrMetallicRoughness.baseColorFactor = factor;
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = 1;
  return static_cast<int>(model.materials.size()) - 1;
}

}  // namespace

tinygltf::Model new_gltf_model() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = std::string("leafhull ") + kVersion;
  model.buffers.emplace_back();
  model.scenes.emplace_back();
  model.defaultScene = 0;
  return model;
}

int add_mesh(tinygltf::Model& model, const Mesh& mesh, Normals normals) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = material_of(model, mesh.colour);
  primitive.attributes["POSITION"] = add_positions(model, mesh);
  primitive.attributes["NORMAL"] = add_normals(model, mesh, normals);
  primitive.indices = add_indices(model, mesh);
  model.meshes.emplace_back();
  model.meshes.back().name = kShapeName;
  model.meshes.back().primitives.push_back(std::move(primitive));
  return static_cast<int>(model.meshes.size()) - 1;
}

int add_root(tinygltf::Model& model, tinygltf::Node node) {
  model.nodes.push_back(std::move(node));
  const int index = static_cast<int>(model.nodes.size()) - 1;
  model.scenes.front().nodes.push_back(index);
  return index;
}

std::size_t gltf_bytes(const Mesh& mesh) {
  return mesh.positions.size() * sizeof(mesh.positions[0]) +
         mesh.normals.size() * sizeof(mesh.normals[0]) +
         mesh.triangles.size() * sizeof(mesh.triangles[0]);
}

bool fits_glb(std::size_t buffer_bytes, std::size_t json_bytes) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  return buffer_bytes <= kMost && json_bytes <= kMost - buffer_bytes;
}

void write_glb(const tinygltf::Model& model, std::ostream& stream) {
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, /*prettyPrint=*/false,
                                              /*writeBinary=*/true);
}

}  // namespace leafhull
