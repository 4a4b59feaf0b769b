// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "leafhull/vec.h"

namespace leafhull {

/// Decoded pixels, 8 bits each of red, green, blue, alpha, rows from the top. Empty where an image
/// could not be read.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
  std::string name{};  ///< its file's name, or its name in the tree file; or none
  bool empty() const { return rgba.empty(); }
};

enum class AlphaMode { opaque, mask, blend };
enum class Wrap { repeat, clamp, mirror };

struct Material {
  std::string name;
  AlphaMode alpha_mode = AlphaMode::opaque;
  double alpha_cutoff = 0.5;                    ///< for `mask`; 0..1
  std::array<float, 4> base_color{1, 1, 1, 1};  ///< linear, multiplies the image
  int base_color_image = -1;                    ///< into TreeModel::images, -1: none
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
};

/// Triangles of one material in the space of their mesh.
struct Primitive {
  std::string mesh_name;
  int material = -1;             ///< into TreeModel::materials, -1: none
  std::vector<Vec3f> positions;  ///< finite
  std::vector<Vec3f> normals;    ///< as many as positions, or none
  std::vector<Vec2f> uvs;  ///< into base_color_image, texture transform applied; v is down; or none
  std::vector<Vec3f> colors;  ///< linear, multiply the base colour; as many as positions, or none
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< every index is below positions.size()
};

/// An affine map in three rows: x' = row . (x, y, z, 1).
using Transform = std::array<std::array<double, 4>, 3>;
inline constexpr Transform kIdentity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

inline Vec3d transformed(const Transform& m, Vec3d p) {
  const auto row = [&](int i) { return m[i][0] * p.x + m[i][1] * p.y + m[i][2] * p.z + m[i][3]; };
  return {row(0), row(1), row(2)};
}

/// The rows of the matrix that turns normals: the inverse transpose of the linear part up to scale.
inline std::array<Vec3d, 3> cofactors(const Transform& m) {
  const auto row = [&](int i) { return Vec3d{m[i][0], m[i][1], m[i][2]}; };
  return {cross(row(1), row(2)), cross(row(2), row(0)), cross(row(0), row(1))};
}

/// A named place in the file's hierarchy: a node of glTF, an object or group of OBJ.
struct TreeNode {
  std::string name;
  int parent = -1;  ///< into TreeModel::nodes, -1: none
  int level = 0;    ///< level of detail from MSFT_lod or an LOD group; 0: the finest, or unknown
};

/// A primitive placed in the scene.
struct Instance {
  std::uint32_t primitive = 0;
  std::string node_name;
  Transform to_world = kIdentity;
  int node = -1;  ///< into TreeModel::nodes, -1: unknown
};

/// What a tree file holds. Instances share primitives.
struct TreeModel {
  std::filesystem::path path;
  std::vector<Image> images;
  std::vector<Material> materials;
  std::vector<Primitive> primitives;
  std::vector<TreeNode> nodes;
  std::vector<Instance> instances;
  std::vector<std::string> warnings;  ///< one line for each thing that was skipped
};

/// The axis of a file that points up in the world.
enum class Up { y, z };

struct ReadOptions {
  std::optional<Up> up;        ///< empty: as the file says, else y
  bool allow_outside = false;  ///< textures and buffers may lie outside of the file's folder
};

/// Reads glTF 2.0 (.glb, .gltf), FBX or Wavefront OBJ; the default scene's nodes become instances,
/// EXT_mesh_gpu_instancing included. FBX comes in metres and upright. SPEC: 1.
/// @throws Error input: the file, its name, and what is wrong at which place in it.
TreeModel read_tree(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace leafhull
