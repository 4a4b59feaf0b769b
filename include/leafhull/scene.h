// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "leafhull/api.h"
#include "leafhull/leaves.h"
#include "leafhull/option_row.h"
#include "leafhull/tree.h"
#include "leafhull/vec.h"

namespace leafhull {

/// A tree model that a scene places.
struct SceneModel {
  std::string name;            ///< its unique name in messages and outputs
  std::filesystem::path file;  ///< for a scatter file: the tree file
  ReadOptions reading;         ///< how `file` is read
  std::string mesh;            ///< for a glTF scene: its mesh
  /// For a glTF scene: the meshes of its models, which share them and their images. Else empty.
  std::shared_ptr<const TreeModel> meshes;
  std::vector<Instance> instances;           ///< of `meshes`: the mesh's leaves, at the origin
  std::shared_ptr<const LeafChoice> choice;  ///< for the triangles and materials of `meshes`
};

/// A tree in the scene: x' = linear x + position.
struct PlacedTree {
  Vec3d position;                                          ///< scene units, as the model's
  std::array<float, 9> linear{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row by row, invertible
  std::uint32_t model = 0;                                 ///< into Scene::models
};
static_assert(sizeof(PlacedTree) == 64);

/// Thousands of trees of a few models. Trees stay symbolic: nothing is expanded.
struct Scene {
  std::filesystem::path path;
  std::vector<SceneModel> models;
  std::vector<PlacedTree> trees;  ///< in the order of the file
  std::size_t skipped = 0;        ///< trees with a scale of zero or values not finite
  std::vector<std::string> warnings;
};

/// Reads a scatter file or a glTF scene.
///
/// A scatter file is .csv, its columns named in a first line (model, x, y, z; then what there is of
/// qx, qy, qz, qw or yaw or rx, ry, rz in degrees; scale or sx, sy, sz), or .jsonl, an object per
/// line (model, position, rotation, scale). Models are tree files, named from the scatter file's
/// folder. A tree is scaled, rotated and moved. In a .glb or .gltf every mesh with leaves is a
/// model and every node that holds it a tree, EXT_mesh_gpu_instancing included.
/// @throws Error input: the file, the line and what is wrong, such as a tree file that is not there
///         or a value that is no number; a file without trees.
LEAFHULL_API Scene read_scene(const std::filesystem::path& path, const LeafOptions& leaves,
                              const ReadOptions& reading = {});

/// The leaves of a scene's model. @throws Error as read_tree and find_leaves do.
LEAFHULL_API LeafSet read_model(const SceneModel& model, const LeafOptions& leaves);

/// Heights over the ground: a grey picture of one or two bytes per pixel.
struct HeightMap {
  std::filesystem::path picture;  ///< PNG, seen from above: +x to the right, +z down
  double height = 10;             ///< from black to white, scene units
};

struct ScatterOptions {
  std::vector<std::filesystem::path> trees;  ///< equally often; one named twice, twice as often
  LeafOptions leaves;                        ///< how the trees' leaves are found
  ReadOptions reading;                       ///< how their files are read
  std::size_t count = 0;                     ///< trees to place, at least 1
  std::uint64_t seed = 1;                    ///< up to 2^31 - 1
  /// Sides of the rectangle along x and z, centred on the origin; empty: as wide as `spacing` asks.
  std::optional<Vec2d> area;
  /// Where `area` is empty: the square root of the area per tree, in widths of the mean crown at
  /// the mean scale. The nearest neighbour is a little nearer.
  double spacing = 0.8;
  double scale_low = 0.8, scale_high = 1.2;  ///< drawn evenly between; > 0
  std::optional<HeightMap> ground;           ///< over the whole rectangle; empty: y = 0
};

/// Ends of a range, and the height map's members, are no direct members of the options.
using ScatterOptionRow =
    RowOf<ScatterOptions, std::size_t ScatterOptions::*, double ScatterOptions::*,
          std::optional<Vec2d> ScatterOptions::*,
          std::pair<double ScatterOptions::*, double ScatterOptions::*>,
          std::pair<std::optional<HeightMap> ScatterOptions::*, std::filesystem::path HeightMap::*>,
          std::pair<std::optional<HeightMap> ScatterOptions::*, double HeightMap::*>>;

/// The options of a scatter, without its trees and how they are read.
LEAFHULL_API std::span<const ScatterOptionRow> scatter_table();

/// Writes a scatter file with trees at the points of a Poisson-disk pattern: no two are closer than
/// about 0.78 sqrt(area / count). Yaws are even. The same options give the same bytes.
/// @throws Error usage: a value out of range; input: a tree or the height map cannot be read;
///         output: the file cannot be written.
LEAFHULL_API void write_scatter(const ScatterOptions& options, const std::filesystem::path& file);

}  // namespace leafhull
