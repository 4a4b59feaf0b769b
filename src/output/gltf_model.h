// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <vector>

#include "leafhull/shape.h"
#include "output/leaf_material.h"

namespace leafhull {

/// A file with one empty buffer and one empty scene.
tinygltf::Model new_gltf_model();

/// Appends `elements` to the file's only buffer, as a buffer view and an accessor over all of it.
/// @param target 0: neither vertices nor indices.
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

enum class Normals { any_length, unit };  ///< a mesh's normals; unit ones are kept bit for bit

/// Appends a mesh and its material; the node that holds it must move it to Mesh::origin.
/// @throws Error internal: a normal without direction.
int add_mesh(tinygltf::Model& model, const Mesh& mesh, Normals normals = Normals::any_length);

/// Appends a root of the scene.
int add_root(tinygltf::Model& model, tinygltf::Node node);

/// The most bytes that add_mesh() adds to the buffer.
std::size_t gltf_bytes(const Mesh& mesh);

/// Whether a GLB of this size fits the format's 32-bit sizes.
bool fits_glb(std::size_t buffer_bytes, std::size_t json_bytes);

void write_glb(const tinygltf::Model& model, std::ostream& stream);

}  // namespace leafhull
