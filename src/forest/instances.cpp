// SPDX-License-Identifier: Apache-2.0
#include "forest/instances.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "leafhull/error.h"
#include "output/gltf_model.h"

namespace leafhull {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

Eigen::Vector3d to_eigen(Vec3d v) { return {v.x, v.y, v.z}; }
Vec3d to_vec(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
std::vector<double> to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
std::vector<double> to_json(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

/// A linear map that glTF can express: x' = rotation (scale x).
struct RotatedScale {
  Eigen::Quaterniond rotation;
  Eigen::Vector3d scale;
};

Eigen::Matrix3d linear_of(const PlacedTree& tree) {
  return Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(tree.linear.data())
      .cast<double>();
}

/// Empty where the map shears: its axes miss right angles by more than float rounding. A map that
/// mirrors has a negative scale along x.
std::optional<RotatedScale> rotated_scale(const Eigen::Matrix3d& linear) {
  constexpr double kRounding = 1e-6;
  Eigen::Vector3d scale = linear.colwise().norm();
  Eigen::Matrix3d axes = linear * scale.cwiseInverse().asDiagonal();
  const Eigen::Matrix3d cosines = axes.transpose() * axes - Eigen::Matrix3d::Identity();
  if (cosines.cwiseAbs().maxCoeff() > kRounding) return std::nullopt;
  if (axes.determinant() < 0) {
    axes.col(0) *= -1;
    scale.x() *= -1;
  }
  return RotatedScale{Eigen::Quaterniond(axes).normalized(), scale};
}

/// Any linear map: x' = outer (inner x).
struct Shear {
  RotatedScale outer;
  Eigen::Quaterniond inner;
};

Shear shear(const Eigen::Matrix3d& linear) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d outer = svd.matrixU(), inner = svd.matrixV().transpose();
  Eigen::Vector3d scale = svd.singularValues();
  if (outer.determinant() < 0) {
    outer.col(0) *= -1;
    scale.x() *= -1;
  }
  if (inner.determinant() < 0) {
    inner.row(0) *= -1;
    scale.x() *= -1;
  }
  return {{Eigen::Quaterniond(outer), scale}, Eigen::Quaterniond(inner)};
}

/// The place of the node that holds a tree as an instance: a point of the coarsest lattice from
/// which floats resolve the way to the tree to 2^-17 of its size. The origin is the first choice.
Vec3d node_place(const Eigen::Vector3d& position, double tree_size) {
  const double reach = std::ldexp(tree_size, 7);
  const double farthest = position.lpNorm<Eigen::Infinity>();
  if (farthest <= reach) return {};
  for (double spacing = std::ldexp(1.0, std::ilogb(farthest) + 1);; spacing /= 2) {
    const Eigen::Vector3d way =
        position.unaryExpr([spacing](double x) { return std::remainder(x, spacing); });
    if (way.lpNorm<Eigen::Infinity>() <= reach) return to_vec(position - way);
  }
}

/// The trees of a model that are near one place; they become a node.
struct Batch {
  std::uint32_t model;
  Vec3d place;

  friend bool operator<(const Batch& a, const Batch& b) {
    const auto key = [](const Batch& batch) {
      return std::tie(batch.model, batch.place.x, batch.place.y, batch.place.z);
    };
    return key(a) < key(b);
  }
};

/// What the accessors of a node hold.
struct Instances {
  std::vector<Vec3f> translations, scales;
  std::vector<std::array<float, 4>> rotations;

  void add(Vec3d translation, const RotatedScale& map) {
    translations.emplace_back(translation);
    const Eigen::Quaternionf q = map.rotation.cast<float>();
    rotations.push_back({q.x(), q.y(), q.z(), q.w()});
    scales.emplace_back(to_vec(map.scale));
  }
};

/// The document while it is built.
class Document {
 public:
  explicit Document(std::span<const ModelShape> shapes) : shapes_(shapes) {
    for (const ModelShape& shape : shapes) {
      Box box;
      for (const Vec3f& position : shape.mesh.positions) box.include(Vec3d(position));
      sizes_.push_back(to_eigen(box.size()));
      meshes_.push_back(box.longest_side() > 0 ? add_mesh(model_, shape.mesh) : -1);
    }
  }

  void place(const PlacedTree& tree) {
    if (meshes_[tree.model] < 0) return;
    const Eigen::Matrix3d linear = linear_of(tree);
    const Eigen::Vector3d position =
        to_eigen(tree.position) + linear * to_eigen(shapes_[tree.model].mesh.origin);
    const std::optional<RotatedScale> map = rotated_scale(linear);
    if (!map) {
      const auto [outer, inner] = shear(linear);
      tinygltf::Node child = node_of(tree.model);
      child.rotation = to_json(inner);
      model_.nodes.push_back(std::move(child));
      const int child_index = static_cast<int>(model_.nodes.size()) - 1;
      add_plain({}, position, outer).children = {child_index};
    } else if (map->scale.x() < 0) {
      add_plain(node_of(tree.model), position, *map);
    } else {
      const double size = map->scale.cwiseProduct(sizes_[tree.model]).maxCoeff();
      const Vec3d place = node_place(position, size);
      batches_[{tree.model, place}].add(to_vec(position) - place, *map);
    }
  }

  tinygltf::Model finish() && {
    for (const auto& [batch, instances] : batches_) add_instances(batch, instances);
    return std::move(model_);
  }

 private:
  tinygltf::Node node_of(std::uint32_t model) const {
    tinygltf::Node node;
    node.name = shapes_[model].name;
    node.mesh = meshes_[model];
    return node;
  }

  tinygltf::Node& add_plain(tinygltf::Node node, const Eigen::Vector3d& position,
                            const RotatedScale& map) {
    node.translation = to_json(position);
    node.rotation = to_json(map.rotation);
    node.scale = to_json(map.scale);
    return model_.nodes[static_cast<std::size_t>(add_root(model_, std::move(node)))];
  }

  void add_instances(const Batch& batch, const Instances& instances) {
    const auto add = [&](const auto& elements, int type) {
      return tinygltf::Value(
          add_accessor(model_, elements, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, type));
    };
    const tinygltf::Value::Object attributes{
        {"TRANSLATION", add(instances.translations, TINYGLTF_TYPE_VEC3)},
        {"ROTATION", add(instances.rotations, TINYGLTF_TYPE_VEC4)},
        {"SCALE", add(instances.scales, TINYGLTF_TYPE_VEC3)}};
    tinygltf::Node node = node_of(batch.model);
    if (batch.place != Vec3d{}) node.translation = to_json(to_eigen(batch.place));
    node.extensions[kInstancing] =
        tinygltf::Value(tinygltf::Value::Object{{"attributes", tinygltf::Value(attributes)}});
    add_root(model_, std::move(node));
    model_.extensionsUsed = model_.extensionsRequired = {kInstancing};
  }

  std::span<const ModelShape> shapes_;
  tinygltf::Model model_ = new_gltf_model();
  std::vector<Eigen::Vector3d> sizes_;  ///< by model
  std::vector<int> meshes_;             ///< by model; -1: none
  std::map<Batch, Instances> batches_;
};

/// @throws Error output.
void check_size(const tinygltf::Model& model, std::size_t shapes, std::size_t trees) {
  constexpr std::size_t kObject = 512, kEscaped = 6;  // bytes of JSON, at most
  std::size_t json = kObject * (model.nodes.size() + model.meshes.size() + model.accessors.size() +
                                model.bufferViews.size() + 1);
  for (const tinygltf::Node& node : model.nodes) json += kEscaped * node.name.size();
  if (fits_glb(model.buffers.front().data.size(), json)) return;
  throw Error(ErrorCode::output,
              std::to_string(shapes) + " shapes and " + std::to_string(trees) +
                  " trees do not fit into the 4 GiB of a GLB",
              "Choose a lower resolution, or divide the scene.");
}

}  // namespace

void write_instances(std::span<const ModelShape> shapes, std::span<const PlacedTree> trees,
                     std::ostream& stream) {
  Document document(shapes);
  for (const PlacedTree& tree : trees) document.place(tree);
  const tinygltf::Model model = std::move(document).finish();
  check_size(model, shapes.size(), trees.size());
  write_glb(model, stream);
}

}  // namespace leafhull
