// SPDX-License-Identifier: Apache-2.0
#include "input/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "input/gltf_accessor.h"

namespace leafhull {
namespace {

using Quaternion = std::array<double, 4>;  // x, y, z, w

Transform operator*(const Transform& a, const Transform& b) {
  Transform product{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      product[row][column] = column == 3 ? a[row][3] : 0;
      for (int k = 0; k < 3; ++k) product[row][column] += a[row][k] * b[k][column];
    }
  }
  return product;
}

Transform compose(Vec3d t, Quaternion q, Vec3d s) {
  const double norm = std::sqrt(std::inner_product(q.begin(), q.end(), q.begin(), 0.0));
  for (double& part : q) part /= norm;
  const auto [x, y, z, w] = q;
  return {
      {{s.x * (1 - 2 * (y * y + z * z)), s.y * 2 * (x * y - z * w), s.z * 2 * (x * z + y * w), t.x},
       {s.x * 2 * (x * y + z * w), s.y * (1 - 2 * (x * x + z * z)), s.z * 2 * (y * z - x * w), t.y},
       {s.x * 2 * (x * z - y * w), s.y * 2 * (y * z + x * w), s.z * (1 - 2 * (x * x + y * y)),
        t.z}}};
}

Transform local_transform(const tinygltf::Node& node) {
  if (!node.matrix.empty()) {
    Transform rows{};
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 4; ++column) {
        rows[row][column] = node.matrix[4 * column + row];
      }
    }
    return rows;
  }
  const auto vec3 = [](const std::vector<double>& v, Vec3d missing) {
    return v.empty() ? missing : Vec3d(v[0], v[1], v[2]);
  };
  const std::vector<double>& r = node.rotation;
  return compose(vec3(node.translation, {0, 0, 0}),
                 r.empty() ? Quaternion{0, 0, 0, 1} : Quaternion{r[0], r[1], r[2], r[3]},
                 vec3(node.scale, {1, 1, 1}));
}

// Visits the transforms of EXT_mesh_gpu_instancing, relative to the node: visit(copy, transform).
template <class Visit>
void visit_copies(GltfFile& file, const tinygltf::Value& extension, const std::string& place,
                  Visit&& visit) {
  const tinygltf::Value& attributes = extension.Get("attributes");
  const auto accessor = [&](const char* name) { return integer(attributes, name, -1); };
  const int translation = accessor("TRANSLATION"), rotation = accessor("ROTATION");
  const int scale = accessor("SCALE");

  std::vector<Vec3f> translations, scales;
  std::vector<std::array<float, 4>> rotations;
  if (translation >= 0) translations = read_vec3(file, translation, place + ", TRANSLATION");
  if (rotation >= 0) rotations = read_vec4(file, rotation, place + ", ROTATION");
  if (scale >= 0) scales = read_vec3(file, scale, place + ", SCALE");
  const std::size_t count = std::max({translations.size(), rotations.size(), scales.size()});
  if ((translation >= 0 && translations.size() != count) ||
      (rotation >= 0 && rotations.size() != count) || (scale >= 0 && scales.size() != count)) {
    file.fail(place, "its attributes differ in count");
  }

  for (std::size_t i = 0; i < count; ++i) {
    Quaternion q{0, 0, 0, 1};
    if (rotation >= 0) std::ranges::copy(rotations[i], q.begin());
    visit(i, compose(translation >= 0 ? Vec3d(translations[i]) : Vec3d(0, 0, 0), q,
                     scale >= 0 ? Vec3d(scales[i]) : Vec3d(1, 1, 1)));
  }
}

std::vector<int> root_nodes(const GltfFile& file) {
  const tinygltf::Model& model = file.model;
  if (model.defaultScene >= 0 && !is_index(model.defaultScene, model.scenes.size())) {
    file.fail("scene", "there is no " + place_of("scenes", model.defaultScene));
  }
  if (!model.scenes.empty()) {
    return model.scenes[std::max(model.defaultScene, 0)].nodes;
  }

  std::vector<bool> is_child(model.nodes.size(), false);
  for (const tinygltf::Node& node : model.nodes) {
    for (const int child : node.children) {
      if (is_index(child, is_child.size())) is_child[child] = true;
    }
  }
  std::vector<int> roots;
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    if (!is_child[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

bool hides_itself(const tinygltf::Node& node) {
  const auto* visibility = find_extension(node.extensions, "KHR_node_visibility");
  if (!visibility) return false;
  const tinygltf::Value& visible = visibility->Get("visible");
  return visible.IsBool() && !visible.Get<bool>();
}

/// A node of the scene.
struct Visited {
  int index;
  const tinygltf::Node& node;
  Transform to_world;
  bool is_hidden;  ///< it or a node above it
};

/// Every node of the scene in depth-first order.
template <class Visit>
void walk(const GltfFile& file, Visit&& visit) {
  struct Stop {
    int node;
    Transform parent;
    bool is_hidden;
  };
  std::vector<Stop> stack;
  const auto push = [&](const std::vector<int>& nodes, const Transform& parent, bool is_hidden) {
    for (std::size_t i = nodes.size(); i-- > 0;) stack.push_back({nodes[i], parent, is_hidden});
  };
  push(root_nodes(file), kIdentity, false);

  std::vector<bool> visited(file.model.nodes.size(), false);
  while (!stack.empty()) {
    const auto [index, parent, above_is_hidden] = stack.back();
    stack.pop_back();
    if (!is_index(index, visited.size())) {
      file.fail("nodes", "there is no " + place_of("nodes", index));
    }
    if (visited[index]) {
      file.fail(place_of("nodes", index),
                "is reached twice: the nodes have a cycle or a node has two parents");
    }
    visited[index] = true;

    const tinygltf::Node& node = file.model.nodes[index];
    const Transform to_world = parent * local_transform(node);
    const bool is_hidden = above_is_hidden || hides_itself(node);
    push(node.children, to_world, is_hidden);
    visit(Visited{index, node, to_world, is_hidden});
  }
}

}  // namespace

std::string place_of(const PlacedMesh& placed) {
  std::string place = place_of("nodes", placed.node);
  if (!placed.copy) return place;
  return place + ", EXT_mesh_gpu_instancing, copy " + std::to_string(*placed.copy);
}

bool is_finite(const Transform& transform) {
  for (const auto& row : transform) {
    for (const double entry : row) {
      if (!std::isfinite(entry)) return false;
    }
  }
  return true;
}

std::vector<TreeNode> node_table(const GltfFile& file) {
  const std::vector<tinygltf::Node>& nodes = file.model.nodes;
  std::vector<TreeNode> table(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    table[i].name = nodes[i].name;
    for (const int child : nodes[i].children) {
      if (is_index(child, table.size())) table[child].parent = static_cast<int>(i);
    }
    const auto* levels = find_extension(nodes[i].extensions, "MSFT_lod");
    if (!levels || !levels->Get("ids").IsArray()) continue;
    const tinygltf::Value& ids = levels->Get("ids");
    for (std::size_t level = 0; level < ids.ArrayLen(); ++level) {
      const tinygltf::Value& id = ids.Get(static_cast<int>(level));
      if (id.IsInt() && is_index(id.GetNumberAsInt(), table.size())) {
        table[id.GetNumberAsInt()].level = static_cast<int>(level) + 1;
      }
    }
  }
  return table;
}

std::map<MeshUse, int> mesh_uses(GltfFile& file) {
  std::map<MeshUse, int> uses;
  int posed = static_cast<int>(file.model.meshes.size());
  std::size_t hidden = 0;
  walk(file, [&](const Visited& at) {
    if (at.node.mesh < 0) return;
    if (at.is_hidden) {
      ++hidden;
      return;
    }
    MeshUse use = use_of(file, at.index);
    const int number = use.is_plain() ? use.mesh : posed;
    if (uses.emplace(std::move(use), number).second && number == posed) ++posed;
  });
  if (hidden > 0) file.notes.push_back(hidden_meshes(hidden));
  return uses;
}

std::vector<Transform> node_transforms(const GltfFile& file) {
  std::vector<Transform> transforms(file.model.nodes.size(), kIdentity);
  walk(file, [&](const Visited& at) { transforms[at.index] = at.to_world; });
  return transforms;
}

void place_meshes(GltfFile& file, const std::map<MeshUse, int>& uses,
                  const std::function<void(const PlacedMesh&)>& place) {
  walk(file, [&](const Visited& at) {
    if (at.node.mesh < 0 || at.is_hidden) return;
    const MeshUse use = use_of(file, at.index);
    const int mesh = uses.at(use);
    const Transform& to_world = use.skin < 0 ? at.to_world : kIdentity;
    const auto* copies = find_extension(at.node.extensions, "EXT_mesh_gpu_instancing");
    if (!copies) return place({mesh, at.index, at.node.name, {}, to_world});
    visit_copies(file, *copies, place_of("nodes", at.index) + ", EXT_mesh_gpu_instancing",
                 [&](std::size_t copy, const Transform& in_node) {
                   place({mesh, at.index, at.node.name, copy, to_world * in_node});
                 });
  });
}

std::vector<PlacedCamera> place_cameras(const GltfFile& file) {
  std::vector<PlacedCamera> placements;
  walk(file, [&](const Visited& at) {
    if (at.node.camera < 0) return;
    const std::string place = place_of("nodes", at.index);
    if (!is_index(at.node.camera, file.cameras.size())) {
      file.fail(place, "there is no " + place_of("cameras", at.node.camera));
    }
    if (!is_finite(at.to_world)) file.fail(place, "has a transform that is not finite");
    placements.push_back({at.node.camera, place, at.to_world});
  });
  return placements;
}

}  // namespace leafhull
