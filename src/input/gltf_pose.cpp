// SPDX-License-Identifier: Apache-2.0
#include "input/gltf_pose.h"

#include <algorithm>
#include <array>

#include "input/gltf_accessor.h"

namespace leafhull {
namespace {

Transform product(const Transform& a, const std::array<float, 16>& columns) {
  Transform result{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      for (std::size_t k = 0; k < 4; ++k) {
        result[row][column] +=
            a[row][k] * (k < 3 ? double{columns[4 * column + k]} : double{columns[4 * column + 3]});
      }
    }
  }
  return result;
}

/// Transforms a normal by the cofactors.
Vec3f turned(const Transform& m, Vec3f normal) {
  const auto [x, y, z] = cofactors(m);
  const Vec3d n(normal);
  return Vec3f(normalized(Vec3d(dot(x, n), dot(y, n), dot(z, n))));
}

/// Adds the targets' displacements.
void morph(GltfFile& file, const tinygltf::Primitive& source, const std::vector<double>& weights,
           const std::string& place, Primitive& primitive) {
  const std::size_t count = std::min(weights.size(), source.targets.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (weights[i] == 0) continue;
    const auto add = [&](const char* name, std::vector<Vec3f>& to) {
      const auto target = source.targets[i].find(name);
      if (target == source.targets[i].end() || to.empty()) return;
      const std::string where = place + ", targets[" + std::to_string(i) + "]." + name;
      const std::vector<Vec3f> moves = read_vec3(file, target->second, where);
      if (moves.size() != to.size()) file.fail(where, "is not one for each vertex");
      for (std::size_t v = 0; v < to.size(); ++v) {
        to[v] = to[v] + moves[v] * static_cast<float>(weights[i]);
      }
    };
    add("POSITION", primitive.positions);
    add("NORMAL", primitive.normals);
  }
}

using Influences = std::vector<std::array<float, 4>>;

/// Poses every vertex by the mean of its joints.
void bend(GltfFile& file, const tinygltf::Primitive& source, const std::vector<Transform>& joints,
          const std::string& place, Primitive& primitive) {
  const std::size_t count = primitive.positions.size();
  std::vector<Transform> blends(count, Transform{});
  std::vector<double> sums(count);
  for (int set = 0;; ++set) {
    const std::string joints_name = "JOINTS_" + std::to_string(set);
    const std::string weights_name = "WEIGHTS_" + std::to_string(set);
    const auto joint = source.attributes.find(joints_name);
    const auto weight = source.attributes.find(weights_name);
    if (joint == source.attributes.end() || weight == source.attributes.end()) break;
    std::string where = place;
    where.append(", ").append(joints_name);
    const Influences which = read_vec4(file, joint->second, where);
    where = place;
    where.append(", ").append(weights_name);
    const Influences how = read_vec4(file, weight->second, where);
    if (which.size() != count || how.size() != count) {
      file.fail(place, "its joints and weights are not one for each vertex");
    }
    for (std::size_t v = 0; v < count; ++v) {
      for (std::size_t k = 0; k < 4; ++k) {
        const double w = double{how[v][k]};
        if (!(w > 0)) continue;
        const double number_of_joint = double{which[v][k]};
        const bool is_joint =
            number_of_joint >= 0 && number_of_joint < static_cast<double>(joints.size());
        if (!is_joint) {
          file.fail(place, "a joint is past its skin's " + std::to_string(joints.size()));
        }
        const Transform& moved = joints[static_cast<std::size_t>(number_of_joint)];
        sums[v] += w;
        for (std::size_t row = 0; row < 3; ++row) {
          for (std::size_t column = 0; column < 4; ++column) {
            blends[v][row][column] += w * moved[row][column];
          }
        }
      }
    }
  }
  for (std::size_t v = 0; v < count; ++v) {
    if (!(sums[v] > 0)) continue;
    Transform blend = blends[v];
    for (auto& row : blend) {
      for (double& entry : row) entry /= sums[v];
    }
    Vec3f& p = primitive.positions[v];
    p = Vec3f(transformed(blend, Vec3d(p)));
    if (!primitive.normals.empty()) primitive.normals[v] = turned(blend, primitive.normals[v]);
  }
}

}  // namespace

MeshUse use_of(const GltfFile& file, int index) {
  const tinygltf::Node& node = file.model.nodes[index];
  if (!is_index(node.mesh, file.model.meshes.size())) {
    file.fail(place_of("nodes", index), "there is no " + place_of("meshes", node.mesh));
  }
  const tinygltf::Mesh& mesh = file.model.meshes[node.mesh];
  MeshUse use{.mesh = node.mesh, .weights = node.weights.empty() ? mesh.weights : node.weights};
  if (std::ranges::all_of(use.weights, [](double w) { return w == 0; })) use.weights.clear();
  const bool has_joints = std::ranges::any_of(mesh.primitives, [](const auto& primitive) {
    return primitive.attributes.contains("JOINTS_0") &&
           !find_extension(primitive.extensions, "KHR_draco_mesh_compression");
  });
  if (node.skin < 0 || !has_joints) return use;  // a skin moves nothing without joints
  if (!is_index(node.skin, file.model.skins.size())) {
    file.fail(place_of("nodes", index), "there is no " + place_of("skins", node.skin));
  }
  use.skin = node.skin;
  return use;
}

GltfPose pose_of(GltfFile& file, const MeshUse& use, const std::vector<Transform>& to_world) {
  GltfPose pose{.joints = {}, .weights = use.weights};
  if (use.skin < 0) return pose;
  const tinygltf::Skin& skin = file.model.skins[use.skin];
  const std::string place = place_of("skins", use.skin);
  std::vector<std::array<float, 16>> inverse;
  if (skin.inverseBindMatrices >= 0) {
    inverse = read_mat4(file, skin.inverseBindMatrices, place + ", inverseBindMatrices");
    if (inverse.size() < skin.joints.size()) {
      file.fail(place, "has fewer inverse bind matrices than joints");
    }
  }
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    if (!is_index(skin.joints[i], to_world.size())) {
      file.fail(place, "there is no " + place_of("nodes", skin.joints[i]));
    }
    const Transform& joint = to_world[skin.joints[i]];
    pose.joints.push_back(inverse.empty() ? joint : product(joint, inverse[i]));
  }
  return pose;
}

void pose_primitive(GltfFile& file, const tinygltf::Primitive& source, const GltfPose& pose,
                    const std::string& place, Primitive& primitive) {
  morph(file, source, pose.weights, place, primitive);
  if (pose.joints.empty()) return;
  if (source.attributes.contains("JOINTS_0")) {
    bend(file, source, pose.joints, place, primitive);
  } else {
    file.notes.push_back(place + ": has no joints in a mesh with a skin; it stays as it was bound");
  }
}

}  // namespace leafhull
