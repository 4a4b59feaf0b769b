// SPDX-License-Identifier: Apache-2.0
#include "input/gltf_primitive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "input/gltf_accessor.h"
#include "input/gltf_compression.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

bool is_finite(Vec2f v) { return std::isfinite(v.x) && std::isfinite(v.y); }
bool is_finite(Vec3f v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool is_color(Vec3f v) { return is_finite(v); }

std::vector<std::uint32_t> numbers_to(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

std::vector<Triangle> strip_or_fan(const std::vector<std::uint32_t>& vertices, int mode) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 2 < vertices.size(); ++i) {
    const std::size_t odd = i % 2;
    const Triangle triangle =
        mode == TINYGLTF_MODE_TRIANGLE_STRIP
            ? Triangle{vertices[i], vertices[i + 1 + odd], vertices[i + 2 - odd]}
            : Triangle{vertices[i + 1], vertices[i + 2], vertices[0]};
    // Strips repeat a vertex to start anew.
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]) {
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

int attribute(const tinygltf::Primitive& source, const std::string& name) {
  const auto found = source.attributes.find(name);
  return found == source.attributes.end() ? -1 : found->second;
}

// Submeshes often share one long list of vertices.
void drop_unused_vertices(Primitive& primitive) {
  std::vector<bool> is_used(primitive.positions.size());
  for (const Triangle& triangle : primitive.triangles) {
    for (const std::uint32_t vertex : triangle) is_used[vertex] = true;
  }
  if (std::ranges::find(is_used, false) == is_used.end()) return;

  std::vector<std::uint32_t> renumbered(is_used.size());
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    if (!is_used[i]) continue;
    primitive.positions[kept] = primitive.positions[i];
    if (!primitive.normals.empty()) primitive.normals[kept] = primitive.normals[i];
    if (!primitive.uvs.empty()) primitive.uvs[kept] = primitive.uvs[i];
    if (!primitive.colors.empty()) primitive.colors[kept] = primitive.colors[i];
    renumbered[i] = kept++;
  }
  primitive.positions.resize(kept);
  if (!primitive.normals.empty()) primitive.normals.resize(kept);
  if (!primitive.uvs.empty()) primitive.uvs.resize(kept);
  if (!primitive.colors.empty()) primitive.colors.resize(kept);
  for (Triangle& triangle : primitive.triangles) {
    for (std::uint32_t& vertex : triangle) vertex = renumbered[vertex];
  }
}

class PrimitiveReader {
 public:
  PrimitiveReader(GltfFile& file, const tinygltf::Primitive& source, std::string place,
                  std::vector<std::string>& warnings)
      : file_(file), source_(source), place_(std::move(place)), warnings_(warnings) {}

  void read(Primitive& primitive, int uv_set, const GltfPose& pose) {
    const std::string uv_name = "TEXCOORD_" + std::to_string(uv_set);
    if (attribute(source_, "POSITION") < 0) file_.fail(place_, "has no POSITION");
    if (const auto* draco = find_extension(source_.extensions, "KHR_draco_mesh_compression")) {
      read_draco(*draco, uv_name, primitive);
    } else {
      read_accessors(uv_name, primitive);
    }
    check_numbers_of_values(primitive);
    pose_primitive(file_, source_, pose, place_, primitive);
    check(primitive);
  }

 private:
  void read_draco(const tinygltf::Value& draco, const std::string& uv_name, Primitive& primitive) {
    const std::string place = place_ + ", KHR_draco_mesh_compression";
    if (attribute(source_, "JOINTS_0") >= 0) {
      warnings_.push_back(place + ": its skin is not applied");
    }
    const tinygltf::Value& ids = draco.Get("attributes");
    const DracoAttributes attributes{.position = integer(ids, "POSITION", -1),
                                     .normal = integer(ids, "NORMAL", -1),
                                     .uv = integer(ids, uv_name, -1),
                                     .color = integer(ids, "COLOR_0", -1)};
    if (attributes.position < 0) file_.fail(place, "has no POSITION");
    const ByteSpan data = view_bytes(file_, integer(draco, "bufferView", -1), place);
    decode_draco(file_, data, attributes, primitive, place);
  }

  void read_accessors(const std::string& uv_name, Primitive& primitive) {
    primitive.positions = read_vec3(file_, attribute(source_, "POSITION"), place_ + ", POSITION");
    if (const int accessor = attribute(source_, "NORMAL"); accessor >= 0) {
      primitive.normals = read_vec3(file_, accessor, place_ + ", NORMAL");
    }
    if (const int accessor = attribute(source_, uv_name); accessor >= 0) {
      primitive.uvs = read_vec2(file_, accessor, place_ + ", " + uv_name);
    }
    if (const int accessor = attribute(source_, "COLOR_0"); accessor >= 0) {
      try {
        primitive.colors = read_colors(file_, accessor, place_ + ", COLOR_0");
      } catch (const Error& error) {  // a tree can do without colours
        warnings_.push_back(std::string(error.what()) + "; the colours are passed over");
      }
    }
    const std::string place = place_ + ", indices";
    if (source_.mode != TINYGLTF_MODE_TRIANGLES) {
      primitive.triangles =
          strip_or_fan(source_.indices >= 0 ? read_indices(file_, source_.indices, place)
                                            : numbers_to(primitive.positions.size()),
                       source_.mode);
    } else if (source_.indices >= 0) {
      primitive.triangles = read_triangles(file_, source_.indices, place);
    } else {
      primitive.triangles = triangles_in_order(primitive.positions.size());
    }
  }

  std::vector<Triangle> triangles_in_order(std::size_t vertices) {
    if (vertices % 3 != 0) {
      file_.fail(place_,
                 "its " + std::to_string(vertices) + " vertices are not three per triangle");
    }
    std::vector<Triangle> triangles;
    triangles.reserve(vertices / 3);
    for (std::uint32_t i = 0; i < vertices; i += 3) triangles.push_back({i, i + 1, i + 2});
    return triangles;
  }

  void check(Primitive& primitive) {
    const std::size_t count = primitive.positions.size();
    const auto bad =
        std::ranges::find_if_not(primitive.positions, [](Vec3f p) { return is_finite(p); });
    if (bad != primitive.positions.end()) {
      file_.fail(place_,
                 "the POSITION of vertex " + std::to_string(bad - primitive.positions.begin()) +
                     " in mesh " + in_quotes(primitive.mesh_name) + " is not finite",
                 kRepairMesh);
    }
    for (const Triangle& triangle : primitive.triangles) {
      for (const std::uint32_t vertex : triangle) {
        if (vertex >= count) {
          file_.fail(place_, "index " + std::to_string(vertex) + " is past its " +
                                 std::to_string(count) + " vertices");
        }
      }
    }
    check_finite(primitive.normals, "normals");
    check_finite(primitive.uvs, "texture coordinates");
    if (!primitive.colors.empty() &&
        (primitive.colors.size() != count || !std::ranges::all_of(primitive.colors, is_color))) {
      warnings_.push_back(place_ + ", COLOR_0: does not hold a finite colour for every vertex; " +
                          "the colours are passed over");
      primitive.colors.clear();
    }
  }

  void check_numbers_of_values(const Primitive& primitive) const {
    const std::size_t count = primitive.positions.size();
    const auto check_number = [&](std::size_t values, const std::string& what) {
      if (values == 0 || values == count) return;
      file_.fail(place_, "has " + std::to_string(values) + ' ' + what + " for " +
                             std::to_string(count) + " vertices");
    };
    check_number(primitive.normals.size(), "normals");
    check_number(primitive.uvs.size(), "texture coordinates");
  }

  template <class Vector>
  void check_finite(const std::vector<Vector>& values, const std::string& what) {
    if (std::ranges::all_of(values, [](Vector v) { return is_finite(v); })) return;
    warnings_.push_back(place_ + ", " + what + ": " + std::string(kNotAllFinite));
  }

  GltfFile& file_;
  const tinygltf::Primitive& source_;
  std::string place_;
  std::vector<std::string>& warnings_;
};

}  // namespace

std::optional<Primitive> read_primitive(GltfFile& file, std::size_t mesh, std::size_t index,
                                        MaterialReader& materials, const GltfPose& pose,
                                        std::vector<std::string>& warnings) {
  const tinygltf::Primitive& source = file.model.meshes[mesh].primitives[index];
  const std::string place = place_of("meshes", mesh) + '.' + place_of("primitives", index);
  if (source.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    file.fail(place, "mode " + std::to_string(source.mode) + " is unknown");
  }
  if (source.mode < TINYGLTF_MODE_TRIANGLES) {
    warnings.push_back(place + ": points or lines were passed over");
    return std::nullopt;
  }

  Primitive primitive;
  primitive.mesh_name = file.model.meshes[mesh].name;
  primitive.material = source.material;
  const TextureMapping mapping = materials.use(source.material, place);
  PrimitiveReader(file, source, place, warnings).read(primitive, mapping.set, pose);
  if (primitive.triangles.empty()) {
    warnings.push_back(place + ": holds no triangles");
    return std::nullopt;
  }
  drop_unused_vertices(primitive);
  mapping.apply(primitive.uvs);
  return primitive;
}

}  // namespace leafhull
