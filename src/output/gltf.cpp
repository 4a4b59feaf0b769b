// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include "leafhull/error.h"
#include "output/gltf_model.h"
#include "output/writers.h"

namespace leafhull {
namespace {

tinygltf::Model to_gltf(const Mesh& mesh, Normals normals = Normals::any_length) {
  constexpr std::size_t kRoomForJson = 1 << 16;
  if (!fits_glb(gltf_bytes(mesh), kRoomForJson)) {
    throw Error(ErrorCode::output,
                "the mesh of " + std::to_string(mesh.triangles.size()) +
                    " triangles does not fit into the 4 GiB of a glTF buffer",
                "Write a .ply, or choose a lower resolution.");
  }
  tinygltf::Model model = new_gltf_model();
  model.buffers.front().data.reserve(gltf_bytes(mesh));
  tinygltf::Node node;
  node.name = kShapeName;
  node.mesh = add_mesh(model, mesh, normals);
  if (mesh.origin != Vec3d{}) {
    node.translation = {mesh.origin.x, mesh.origin.y, mesh.origin.z};
  }
  add_root(model, std::move(node));
  return model;
}

}  // namespace

void write_glb(const Mesh& mesh, std::ostream& stream) { write_glb(to_gltf(mesh), stream); }

void write_glb_again(const Mesh& mesh, std::ostream& stream) {
  write_glb(to_gltf(mesh, Normals::unit), stream);
}

void write_gltf(const Mesh& mesh, std::ostream& stream) {
  const tinygltf::Model model = to_gltf(mesh);
  tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, /*prettyPrint=*/true,
                                              /*writeBinary=*/false);
}

}  // namespace leafhull
