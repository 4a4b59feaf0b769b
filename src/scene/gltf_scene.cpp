// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_scene.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "foliage/words.h"
#include "input/file_bytes.h"
#include "input/gltf_meshes.h"
#include "input/input_error.h"
#include "input/up.h"
#include "scene/scene_builder.h"

namespace leafhull {
namespace {

namespace fs = std::filesystem;

/// A model with fewer leaf vertices is probably a part of a tree.
constexpr std::size_t kFewLeafVertices = 64;

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

/// Collects a file's placed meshes as trees: a first pass over all of them finds out what leaves
/// are, then each is taken.
class TreeCollector {
 public:
  TreeCollector(SceneBuilder& builder, const LeafOptions& leaves)
      : builder_(builder), leaves_(leaves) {}

  /// Notes the instances of a node, whose copies are alike.
  void survey(const GltfMeshes& meshes, const PlacedMesh& placed) {
    if (placed.copy.value_or(0) != 0) return;
    nodes_[placed.node] = instances_.size();
    for (const std::uint32_t primitive : meshes.primitives.at(placed.mesh)) {
      instances_.push_back({primitive, placed.node_name, placed.to_world, placed.node});
    }
  }

  void take(const GltfMeshes& meshes, const PlacedMesh& placed) {
    if (!choice_) {
      choice_ = std::make_shared<LeafChoice>(choose_leaves(meshes.tree, instances_, leaves_));
      for (const std::string& warning : choice_->warnings) builder_.warn(warning);
      choice_->warnings.clear();
      choice_->welded.reset();  // it would stay for as long as the scene
    }
    if (placed.node != node_) look_at(meshes, placed);
    if (leaf_vertices_ == 0) return;
    builder_.add(
        to_tree(placed.to_world), [&] { return model(meshes, placed); },
        [&] { return place_of(placed); });
  }

  const std::shared_ptr<LeafChoice>& choice() const { return choice_; }

  bool looks_like_one_tree() {
    const auto middle = leaf_vertices_of_models_.begin() +
                        static_cast<std::ptrdiff_t>(leaf_vertices_of_models_.size() / 2);
    std::nth_element(leaf_vertices_of_models_.begin(), middle, leaf_vertices_of_models_.end());
    return *middle < kFewLeafVertices;
  }

 private:
  /// Looks for leaves. The node's name counts too, so one mesh may be several models.
  void look_at(const GltfMeshes& meshes, const PlacedMesh& placed) {
    node_ = placed.node;
    is_leaf_.clear();
    leaf_vertices_ = 0;
    std::size_t at = nodes_.at(placed.node);
    for (const std::uint32_t primitive : meshes.primitives.at(placed.mesh)) {
      is_leaf_.push_back(choice_->instances[at++]);
      if (is_leaf_.back()) leaf_vertices_ += meshes.tree.primitives[primitive].positions.size();
    }
  }

  std::uint32_t model(const GltfMeshes& meshes, const PlacedMesh& placed) {
    const auto [known, is_new] = models_.try_emplace({placed.mesh, is_leaf_});
    if (is_new) {
      SceneModel model;
      const std::vector<std::uint32_t>& primitives = meshes.primitives.at(placed.mesh);
      model.mesh = meshes.tree.primitives[primitives.front()].mesh_name;
      for (std::size_t i = 0; i < primitives.size(); ++i) {
        if (is_leaf_[i]) model.instances.push_back({primitives[i], placed.node_name, kIdentity});
      }
      const std::string name =
          model.mesh.empty() ? "mesh-" + std::to_string(placed.mesh) : printable(model.mesh);
      known->second = builder_.add_model(std::move(model), name);
      leaf_vertices_of_models_.push_back(leaf_vertices_);
    }
    return known->second;
  }

  SceneBuilder& builder_;
  const LeafOptions& leaves_;
  std::vector<Instance> instances_;     ///< the primitives of each node
  std::map<int, std::size_t> nodes_;    ///< where a node's instances begin
  std::shared_ptr<LeafChoice> choice_;  ///< of `instances_`
  std::map<std::pair<int, std::vector<bool>>, std::uint32_t> models_;  ///< by mesh and its leaves
  std::vector<std::size_t> leaf_vertices_of_models_;

  // The node at hand.
  int node_ = -1;
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

Scene read_gltf_scene(const fs::path& file, const LeafOptions& leaves, const ReadOptions& reading) {
  SceneBuilder builder(file);
  TreeCollector trees(builder, leaves);
  auto tree = std::make_shared<TreeModel>();
  const auto upright = [&](const PlacedMesh& placed) {
    PlacedMesh standing = placed;
    if (reading.up == Up::z) standing.to_world = z_up_to_y_up(placed.to_world);
    return standing;
  };
  {
    const Bytes bytes =
        read_named_file(file, "Give the path of a .glb or .gltf file that you may read.");
    *tree =
        read_gltf_meshes(
            bytes, file.string(), Companions(file, reading.allow_outside),
            [&](const auto& meshes, const auto& placed) { trees.take(meshes, upright(placed)); },
            [&](const auto& meshes, const auto& placed) { trees.survey(meshes, upright(placed)); })
            .tree;
  }
  tree->path = file;
  for (const std::string& warning : tree->warnings) builder.warn(warning);
  std::vector<SceneModel>& models = builder.scene().models;
  if (models.empty() && builder.scene().skipped == 0) {
    throw_no_leaves(*tree, trees.choice() ? *trees.choice() : LeafChoice{}, leaves);
  }
  strip(*tree, models);
  for (SceneModel& model : models) {
    model.meshes = tree;
    model.choice = trees.choice();
  }
  if (!models.empty() && trees.looks_like_one_tree()) {
    builder.warn(
        "has few leaves in a mesh and looks like one tree, not a scene: leafhull extract "
        "is for a tree, and a scatter file places trees");
  }
  return builder.finish();
}

}  // namespace leafhull
