// SPDX-License-Identifier: Apache-2.0
#include "input/obj.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "input/input_error.h"
#include "input/obj_materials.h"
#include "input/obj_text.h"
#include "input/obj_vertices.h"
#include "input/polygon.h"
#include "input/tinyobj_double.h"

namespace leafhull {
namespace {

/// A corner of a face: indices from zero, -1 where the file gives none.
struct Corner {
  int position = -1, uv = -1, normal = -1;
  friend auto operator<=>(const Corner&, const Corner&) = default;
};

/// The faces of one object, group and material.
struct Part {
  std::string mesh_name, node_name;
  int node = -1;
  int material = -1;
  std::vector<Corner> corners{};
  std::vector<std::size_t> faces{};  // the end of each in `corners`
};

constexpr std::string_view kExportObjAgain =
    "Export the tree again, as OBJ with all its vertices or as a .glb file.";

/// Collects the file's parts through tinyobjloader's callbacks: its own triangulation loses concave
/// polygons.
class Collector {
 public:
  Collector(const std::string& file, ObjMaterials& materials)
      : file_(file), materials_(materials) {}

  void run(std::string text) {
    tinyobj_double::callback_t callback;
    callback.vertex_cb = [](void* self, auto...) { ++of(self).position_count_; };
    callback.normal_cb = [](void* self, auto...) { ++of(self).normal_count_; };
    callback.texcoord_cb = [](void* self, auto...) { ++of(self).uv_count_; };
    callback.index_cb = [](void* self, tinyobj_double::index_t* corners, int count) {
      of(self).add_face({corners, static_cast<std::size_t>(count)});
    };
    callback.usemtl_cb = [](void* self, const char* rest_of_line, int) {
      const std::string name = rest_of_line;
      of(self).material_ =
          of(self).materials_.find_or_add(name.substr(0, name.find_last_not_of(" \t") + 1));
      of(self).part_ = nullptr;
    };
    callback.group_cb = [](void* self, const char** names, int count) {
      std::string& group = of(self).group_;
      group.clear();
      for (int i = 0; i < count; ++i) (group += i > 0 ? " " : "") += names[i];
      of(self).part_ = nullptr;
    };
    callback.object_cb = [](void* self, const char* name) {
      of(self).object_ = name;
      of(self).group_.clear();
      of(self).part_ = nullptr;
    };
    std::istringstream stream(std::move(text));
    tinyobj_double::LoadObjWithCallback(stream, callback, this);
  }

  std::vector<Part> parts;
  std::vector<TreeNode> nodes;  ///< objects, and groups in them

 private:
  /// The index of the node of that name in `parent`; `parent` itself if the name is empty.
  int node_of(int parent, const std::string& name) {
    if (name.empty()) return parent;
    const auto [entry, is_new] = node_numbers_.emplace(std::pair(parent, name), nodes.size());
    if (is_new) nodes.push_back({name, parent});
    return static_cast<int>(entry->second);
  }

  static Collector& of(void* self) { return *static_cast<Collector*>(self); }

  void add_face(std::span<const tinyobj_double::index_t> corners) {
    ++face_count_;
    if (corners.size() < 3) return;
    Part& part = current_part();
    for (const tinyobj_double::index_t& corner : corners) {
      part.corners.push_back({index(corner.vertex_index, position_count_, true),
                              index(corner.texcoord_index, uv_count_, false),
                              index(corner.normal_index, normal_count_, false)});
    }
    part.faces.push_back(part.corners.size());
  }

  // OBJ indices count from one, or backwards from the last; zero means none.
  int index(int written, std::size_t count, bool required) const {
    const std::int64_t index = written < 0 ? static_cast<std::int64_t>(count) + written
                                           : static_cast<std::int64_t>(written) - 1;
    if ((written == 0 && required) || index < -1 || (written < 0 && index < 0)) {
      input_error(file_, "face " + std::to_string(face_count_),
                  "index " + std::to_string(written) + " names no vertex", kExportObjAgain);
    }
    return static_cast<int>(index);
  }

  Part& current_part() {
    if (!part_) {
      const auto [entry, is_new] =
          numbers_.emplace(std::tuple(object_, group_, material_), parts.size());
      if (is_new) {
        parts.push_back({.mesh_name = group_.empty() ? object_ : group_,
                         .node_name = object_.empty() ? group_ : object_,
                         .node = node_of(node_of(-1, object_), group_),
                         .material = material_});
      }
      part_ = &parts[entry->second];
    }
    return *part_;
  }

  const std::string& file_;
  ObjMaterials& materials_;
  std::map<std::tuple<std::string, std::string, int>, std::size_t> numbers_;
  std::map<std::pair<int, std::string>, std::size_t> node_numbers_;
  std::string object_, group_;
  int material_ = -1;
  Part* part_ = nullptr;
  std::size_t position_count_ = 0, normal_count_ = 0, uv_count_ = 0, face_count_ = 0;
};

/// Turns parts into primitives around an origin.
class PrimitiveMaker {
 public:
  PrimitiveMaker(const ObjVertices& vertices, const ObjMaterials& materials,
                 const std::string& file)
      : vertices_(vertices), materials_(materials), file_(file) {}

  /// The middle of a tree that lies so far out that floats would lose its shape, else zero.
  Vec3d origin(const std::vector<Part>& parts) const {
    Box box;
    for (const Part& part : parts) {
      for (const Corner& corner : part.corners) box.include(vertices_.positions[corner.position]);
    }
    const Vec3d middle = (box.low + box.high) / 2;
    return length(middle) > 16 * box.longest_side() ? middle : Vec3d{};
  }

  void check(const Part& part) const {
    const auto inside = [](int index, std::size_t count) {
      return index < static_cast<std::int64_t>(count);
    };
    for (const Corner& corner : part.corners) {
      if (!inside(corner.position, vertices_.positions.size()) ||
          !inside(corner.uv, vertices_.uvs.size()) ||
          !inside(corner.normal, vertices_.normals.size())) {
        input_error(file_, "a face of " + in_quotes(part.mesh_name),
                    "index past the vertices, normals or texture coordinates of the file",
                    kExportObjAgain);
      }
      const Vec3d p = vertices_.positions[corner.position];
      if (!std::isfinite(static_cast<float>(p.x)) || !std::isfinite(static_cast<float>(p.y)) ||
          !std::isfinite(static_cast<float>(p.z))) {
        input_error(file_, "vertex " + std::to_string(corner.position + 1), "is not finite",
                    kRepairMesh);
      }
    }
  }

  Primitive make(const Part& part, Vec3d origin) const {
    Primitive primitive;
    primitive.mesh_name = part.mesh_name;
    primitive.material = part.material;
    const bool has_normals = std::ranges::all_of(part.corners, &has_normal);
    const bool has_uvs = std::ranges::all_of(part.corners, &has_uv);
    std::map<Corner, std::uint32_t> numbers;
    const auto vertex = [&](const Corner& corner) {
      const auto [entry, is_new] =
          numbers.emplace(corner, static_cast<std::uint32_t>(numbers.size()));
      if (is_new) {
        primitive.positions.push_back(Vec3f(vertices_.positions[corner.position] - origin));
        if (has_normals) primitive.normals.push_back(vertices_.normals[corner.normal]);
        if (!vertices_.colors.empty()) {
          primitive.colors.push_back(vertices_.colors[corner.position]);
        }
        if (has_uvs) primitive.uvs.push_back(image_uv(part.material, vertices_.uvs[corner.uv]));
      }
      return entry->second;
    };

    std::vector<Vec3d> polygon;
    std::size_t begin = 0;
    for (const std::size_t end : part.faces) {
      polygon.clear();
      for (std::size_t i = begin; i < end; ++i) {
        polygon.push_back(vertices_.positions[part.corners[i].position]);
      }
      for (const auto& [a, b, c] : triangulate(polygon)) {
        primitive.triangles.push_back({vertex(part.corners[begin + a]),
                                       vertex(part.corners[begin + b]),
                                       vertex(part.corners[begin + c])});
      }
      begin = end;
    }
    return primitive;
  }

 private:
  static bool has_normal(const Corner& corner) { return corner.normal >= 0; }
  static bool has_uv(const Corner& corner) { return corner.uv >= 0; }

  Vec2f image_uv(int material, Vec2d uv) const {
    if (material < 0) return {static_cast<float>(uv.x), static_cast<float>(1 - uv.y)};
    return image_coordinates(materials_.materials[material], uv.x, uv.y);
  }

  const ObjVertices& vertices_;
  const ObjMaterials& materials_;
  const std::string& file_;
};

}  // namespace

TreeModel read_obj(ByteSpan bytes, const std::string& file, const Companions& companions) {
  const std::string_view written = text_of(bytes);
  if (written.starts_with("\xFF\xFE") || written.starts_with("\xFE\xFF")) {
    input_error(file, "", "is UTF-16 text", "Save it as UTF-8.");
  }
  std::string text = obj_text(written);
  std::vector<std::string> warnings;
  ObjMaterials materials = read_material_libraries(text, companions, warnings);
  TreeModel tree = read_obj_text(std::move(text), file, std::move(materials), companions);
  tree.warnings.insert(tree.warnings.begin(), warnings.begin(), warnings.end());
  return tree;
}

TreeModel read_obj_text(std::string text, const std::string& file, ObjMaterials materials,
                        const Companions& companions) {
  TreeModel tree;
  const ObjVertices vertices = read_obj_vertices(text, file, tree.warnings);
  Collector obj(file, materials);
  obj.run(std::move(text));
  if (obj.parts.empty()) {
    input_error(file, "", "holds no faces",
                "Give an OBJ file with polygons (lines that begin with f).");
  }

  const PrimitiveMaker maker(vertices, materials, file);
  for (const Part& part : obj.parts) maker.check(part);
  const Vec3d origin = maker.origin(obj.parts);
  Transform to_world = kIdentity;
  to_world[0][3] = origin.x;
  to_world[1][3] = origin.y;
  to_world[2][3] = origin.z;

  std::vector<bool> used(materials.materials.size(), false);
  for (const Part& part : obj.parts) {
    if (part.material >= 0) used[part.material] = true;
    tree.instances.push_back(
        {static_cast<std::uint32_t>(tree.primitives.size()), part.node_name, to_world, part.node});
    tree.primitives.push_back(maker.make(part, origin));
  }
  tree.nodes = std::move(obj.nodes);
  add_materials(materials, used, companions, tree);
  return tree;
}

}  // namespace leafhull
