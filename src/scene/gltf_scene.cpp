// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_scene.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "input/file_bytes.h"
#include "input/gltf_meshes.h"
#include "input/input_error.h"
#include "scene/scene_builder.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

/// A model with fewer leaf vertices is probably a part of a tree.
constexpr std::size_t kFewLeafVertices = 64;

Bytes read_scene_file(const fs::path& file) try {
  return read_file(file, Pipes::read);
} catch (const FileError& error) {
  input_error(file.string(), "", std::string("cannot be read: ") + error.what(),
              "Give the path of a .glb or .gltf file that you may read.");
}

PlacedTree to_tree(const Transform& to_world) {
  PlacedTree tree;
  tree.position = {to_world[0][3], to_world[1][3], to_world[2][3]};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      tree.linear[3 * row + column] = static_cast<float>(to_world[row][column]);
    }
  }
  return tree;
}

/// Takes the placed meshes of a file, one after the other, for trees.
class TreeCollector {
 public:
  TreeCollector(SceneBuilder& builder, const LeafOptions& leaves)
      : builder_(builder), leaves_(leaves) {}

  void take(const GltfMeshes& meshes, const PlacedMesh& placed) {
    if (placed.node != node_) look_at(meshes, placed);
    if (leaf_vertices_ == 0) return;
    builder_.add(
        to_tree(placed.to_world), [&] { return model(meshes, placed); },
        [&] { return place_of(placed); });
  }

  /// Instances of the meshes that are no trees, each mesh once.
  const std::vector<Instance>& others() const { return others_; }

  bool looks_like_one_tree() {
    const auto middle = leaf_vertices_of_models_.begin() +
                        static_cast<std::ptrdiff_t>(leaf_vertices_of_models_.size() / 2);
    std::nth_element(leaf_vertices_of_models_.begin(), middle, leaf_vertices_of_models_.end());
    return *middle < kFewLeafVertices;
  }

 private:
  /// Looks for leaves. Names decide, the node's among them: one mesh may be several models.
  void look_at(const GltfMeshes& meshes, const PlacedMesh& placed) {
    node_ = placed.node;
    instances_.clear();
    is_leaf_.clear();
    leaf_vertices_ = 0;
    for (const std::uint32_t primitive : meshes.primitives.at(placed.mesh)) {
      instances_.push_back({primitive, placed.node_name, kIdentity});
      is_leaf_.push_back(is_leaf(meshes.tree, instances_.back(), leaves_));
      if (is_leaf_.back()) leaf_vertices_ += meshes.tree.primitives[primitive].positions.size();
    }
    if (leaf_vertices_ == 0 && other_meshes_.insert(placed.mesh).second) {
      others_.insert(others_.end(), instances_.begin(), instances_.end());
    }
  }

  std::uint32_t model(const GltfMeshes& meshes, const PlacedMesh& placed) {
    const auto [known, is_new] = models_.try_emplace({placed.mesh, is_leaf_});
    if (is_new) {
      SceneModel model;
      model.mesh = meshes.tree.primitives[instances_.front().primitive].mesh_name;
      model.instances = instances_;
      const std::string name =
          model.mesh.empty() ? "mesh-" + std::to_string(placed.mesh) : printable(model.mesh);
      known->second = builder_.add_model(std::move(model), name);
      leaf_vertices_of_models_.push_back(leaf_vertices_);
    }
    return known->second;
  }

  SceneBuilder& builder_;
  const LeafOptions& leaves_;
  std::map<std::pair<int, std::vector<bool>>, std::uint32_t> models_;  ///< by mesh and its leaves
  std::vector<std::size_t> leaf_vertices_of_models_;
  std::set<int> other_meshes_;
  std::vector<Instance> others_;

  // Of the node at hand.
  int node_ = -1;
  std::vector<Instance> instances_;
  std::vector<bool> is_leaf_;
  std::size_t leaf_vertices_ = 0;
};

/// Frees what no model needs.
void strip(TreeModel& tree, const std::vector<SceneModel>& models) {
  std::vector<bool> used(tree.primitives.size()), seen(tree.images.size());
  for (const SceneModel& model : models) {
    for (const Instance& instance : model.instances) used[instance.primitive] = true;
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    Primitive& primitive = tree.primitives[i];
    const int image =
        primitive.material < 0 ? -1 : tree.materials[primitive.material].base_color_image;
    if (!used[i]) primitive = {};
    if (used[i] && image >= 0) seen[image] = true;
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i]) tree.images[i] = {};
  }
}

}  // namespace

Scene read_gltf_scene(const fs::path& file, const LeafOptions& leaves) {
  SceneBuilder builder(file);
  TreeCollector trees(builder, leaves);
  auto tree = std::make_shared<TreeModel>();
  {
    const Bytes bytes = read_scene_file(file);
    *tree = read_gltf_meshes(
                bytes, file.string(), file.parent_path(),
                [&](const auto& meshes, const auto& placed) { trees.take(meshes, placed); })
                .tree;
  }
  tree->path = file;
  for (const std::string& warning : tree->warnings) builder.warn(warning);
  std::vector<SceneModel>& models = builder.scene().models;
  if (models.empty() && builder.scene().skipped == 0) {
    (void)find_leaves(*tree, trees.others(), leaves);  // says why there are none
  }
  strip(*tree, models);
  for (SceneModel& model : models) model.meshes = tree;
  if (!models.empty() && trees.looks_like_one_tree()) {
    builder.warn(
        "has few leaves in a mesh and looks like one tree, not a scene: leafhull extract "
        "is for a tree, and a scatter file places trees");
  }
  return builder.finish();
}

}  // namespace leafhull
