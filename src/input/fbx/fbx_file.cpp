// SPDX-License-Identifier: Apache-2.0
#include <ufbx.h>

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "input/fbx.h"
#include "input/fbx/fbx_materials.h"
#include "input/fbx/fbx_mesh.h"
#include "input/fbx/fbx_text.h"
#include "input/input_error.h"

namespace leafhull {
namespace {

constexpr std::uint32_t kDeepestNode = 512;
/// A few bytes can claim any size.
constexpr std::size_t kMemory = std::size_t{1} << 30, kMemoryPerByte = 256;

using Scene = std::unique_ptr<ufbx_scene, void (*)(ufbx_scene*)>;

Scene load(ByteSpan bytes, const std::string& name, Axes axes) {
  ufbx_load_opts options{};
  options.file_format = UFBX_FILE_FORMAT_FBX;
  options.ignore_animation = true;
  options.evaluate_skinning = true;
  options.clean_skin_weights = true;
  options.node_depth_limit = kDeepestNode;
  options.target_unit_meters = 1;
  if (axes == Axes::as_it_says) options.target_axes = ufbx_axes_right_handed_y_up;
  for (ufbx_allocator_opts* allocator : {&options.temp_allocator, &options.result_allocator}) {
    allocator->memory_limit = kMemory + kMemoryPerByte * bytes.size();
  }
  ufbx_error error;
  Scene scene(ufbx_load_memory(bytes.data(), bytes.size(), &options, &error), &ufbx_free_scene);
  if (!scene) {
    std::string what = "cannot be read as FBX: " + text_of(error.description);
    if (error.info_length > 0) {
      what += " (" + std::string(printable({error.info, error.info_length}, 100)) + ")";
    }
    input_error(name, "", what, "Open it in Blender, and export it as FBX or .glb again.");
  }
  return scene;
}

Transform transform_of(const ufbx_matrix& m) {
  return {
      {{m.m00, m.m01, m.m02, m.m03}, {m.m10, m.m11, m.m12, m.m13}, {m.m20, m.m21, m.m22, m.m23}}};
}

bool is_finite_transform(const Transform& transform) {
  double sum = 0;
  for (const auto& row : transform) {
    for (const double entry : row) sum += entry;
  }
  return std::isfinite(sum);
}

/// Takes the meshes of a scene, node by node.
class FbxReader {
 public:
  FbxReader(const ufbx_scene& scene, const std::string& name, const Companions& companions)
      : scene_(scene), name_(name), materials_(companions, tree_) {}

  TreeModel read() && {
    for (std::size_t i = 0; i < scene_.metadata.warnings.count; ++i) {
      tree_.warnings.push_back(
          "FBX: " + printable(text_of(scene_.metadata.warnings.data[i].description), 200));
    }
    tree_.nodes.resize(scene_.nodes.count);
    for (std::size_t i = 0; i < scene_.nodes.count; ++i) describe(*scene_.nodes.data[i]);
    for (std::size_t i = 0; i < scene_.nodes.count; ++i) place(*scene_.nodes.data[i]);
    materials_.decode_images();
    if (unread_ > 0) {
      tree_.warnings.push_back(std::to_string(unread_) + " NURBS or lines are passed over");
    }
    if (hidden_ > 0) tree_.warnings.push_back(hidden_meshes(hidden_));
    if (tree_.instances.empty()) {
      input_error(name_, "", "holds no visible triangles", "Export the tree as polygon meshes.");
    }
    return std::move(tree_);
  }

 private:
  void describe(const ufbx_node& node) {
    TreeNode& told = tree_.nodes[node.typed_id];
    told.name = text_of(node.name);
    if (node.parent) told.parent = static_cast<int>(node.parent->typed_id);
    if (node.attrib_type != UFBX_ELEMENT_LOD_GROUP) return;
    for (std::size_t level = 0; level < node.children.count; ++level) {
      tree_.nodes[node.children.data[level]->typed_id].level = static_cast<int>(level);
    }
  }

  static bool is_seen(const ufbx_node& node) {
    for (const ufbx_node* at = &node; at; at = at->parent) {
      if (!at->visible) return false;
    }
    return true;
  }

  void place(const ufbx_node& node) {
    const bool is_curved = node.attrib_type == UFBX_ELEMENT_NURBS_SURFACE ||
                           node.attrib_type == UFBX_ELEMENT_NURBS_CURVE ||
                           node.attrib_type == UFBX_ELEMENT_NURBS_TRIM_SURFACE ||
                           node.attrib_type == UFBX_ELEMENT_LINE_CURVE;
    if (is_curved && is_seen(node)) ++unread_;
    if (!node.mesh || node.mesh->num_triangles == 0) return;
    if (!is_seen(node)) {
      ++hidden_;
      return;
    }
    const ufbx_mesh& mesh = *node.mesh;
    // A mesh posed by joints may be in world coordinates already.
    const Transform to_world =
        mesh.skinned_is_local ? transform_of(node.geometry_to_world) : kIdentity;
    if (!is_finite_transform(to_world)) {
      input_error(name_, "node " + in_quotes(text_of(node.name)),
                  "has a transform that is not finite", kRepairMesh);
    }
    for (std::size_t i = 0; i < mesh.material_parts.count; ++i) {
      const ufbx_material* material = i < node.materials.count   ? node.materials.data[i]
                                      : i < mesh.materials.count ? mesh.materials.data[i]
                                                                 : nullptr;
      const auto number = primitive_of(mesh, i, material);
      if (number) {
        tree_.instances.push_back(
            {*number, text_of(node.name), to_world, static_cast<int>(node.typed_id)});
      }
    }
  }

  std::optional<std::uint32_t> primitive_of(const ufbx_mesh& mesh, std::size_t part,
                                            const ufbx_material* material) {
    const auto [entry, is_new] =
        primitives_.emplace(std::tuple(&mesh, part, material), std::nullopt);
    if (!is_new) return entry->second;
    auto primitive = read_fbx_part(mesh, mesh.material_parts.data[part],
                                   FbxMaterials::colour_texture(material), name_);
    if (!primitive) return std::nullopt;
    primitive->material = materials_.use(material);
    entry->second = static_cast<std::uint32_t>(tree_.primitives.size());
    tree_.primitives.push_back(std::move(*primitive));
    return entry->second;
  }

  const ufbx_scene& scene_;
  const std::string& name_;
  TreeModel tree_;
  FbxMaterials materials_;
  std::map<std::tuple<const ufbx_mesh*, std::size_t, const ufbx_material*>,
           std::optional<std::uint32_t>>
      primitives_;
  std::size_t hidden_ = 0, unread_ = 0;
};

}  // namespace

TreeModel read_fbx(ByteSpan bytes, const std::string& name, const Companions& companions,
                   Axes axes) {
  const Scene scene = load(bytes, name, axes);
  return FbxReader(*scene, name, companions).read();
}

}  // namespace leafhull
