// SPDX-License-Identifier: Apache-2.0
#include "input/fbx/fbx_mesh.h"

#include <cmath>
#include <vector>

#include "colour/colour.h"
#include "input/fbx/fbx_text.h"
#include "input/images.h"
#include "input/input_error.h"
#include "input/polygon.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

/// The attributes of a triangle's corner.
struct FbxCorner {
  Vec3f position, normal, color;
  Vec2f uv;
};

const ufbx_vertex_vec2& uvs_of(const ufbx_mesh& mesh, const ufbx_texture* colour) {
  for (std::size_t i = 0; colour && i < mesh.uv_sets.count; ++i) {
    const ufbx_uv_set& set = mesh.uv_sets.data[i];
    if (colour->uv_set.length > 0 && text_of(set.name) == text_of(colour->uv_set)) {
      return set.vertex_uv;
    }
  }
  return mesh.vertex_uv;
}

/// In the texture's space, v down.
Vec2f image_uv(ufbx_vec2 uv, const ufbx_texture* colour) {
  ufbx_vec3 at{};
  at.x = uv.x, at.y = uv.y;
  if (colour && colour->has_uv_transform) at = ufbx_transform_position(&colour->uv_to_texture, at);
  return {static_cast<float>(at.x), static_cast<float>(1 - at.y)};
}

Vec3f vec3f(ufbx_vec3 v) { return Vec3f(Vec3d(v.x, v.y, v.z)); }

Vec3f colour_of(ufbx_vec4 c) {
  return Vec3f(Vec3d(linear_of_srgb(share_of(c.x)), linear_of_srgb(share_of(c.y)),
                     linear_of_srgb(share_of(c.z))));
}

bool is_finite_vec(Vec3f v) { return std::isfinite(v.x + v.y + v.z); }

}  // namespace

std::optional<Primitive> read_fbx_part(const ufbx_mesh& mesh, const ufbx_mesh_part& part,
                                       const ufbx_texture* colour, const std::string& file) {
  const ufbx_vertex_vec3& positions = mesh.skinned_position;
  const ufbx_vertex_vec3& normals = mesh.skinned_normal;
  const ufbx_vertex_vec2& uvs = uvs_of(mesh, colour);
  const bool has_colors = mesh.vertex_color.exists && !colour;

  std::vector<FbxCorner> corners;
  std::vector<Vec3d> polygon;
  corners.reserve(3 * part.num_triangles);
  for (std::size_t i = 0; i < part.face_indices.count; ++i) {
    const std::uint32_t number = part.face_indices.data[i];
    const ufbx_face face = mesh.faces.data[number];
    const bool is_hole = mesh.face_hole.count > number && mesh.face_hole.data[number];
    if (face.num_indices < 3 || is_hole) continue;
    const auto take = [&](std::uint32_t corner) {
      const std::size_t index = face.index_begin + corner;
      FbxCorner taken{};
      taken.position = vec3f(ufbx_get_vertex_vec3(&positions, index));
      if (!is_finite_vec(taken.position)) {
        input_error(file, "mesh " + in_quotes(text_of(mesh.name)),
                    "has a vertex that is not finite", kRepairMesh);
      }
      if (normals.exists) taken.normal = vec3f(ufbx_get_vertex_vec3(&normals, index));
      if (uvs.exists) taken.uv = image_uv(ufbx_get_vertex_vec2(&uvs, index), colour);
      if (has_colors) taken.color = colour_of(ufbx_get_vertex_vec4(&mesh.vertex_color, index));
      corners.push_back(taken);
    };
    if (face.num_indices == 3) {
      for (std::uint32_t corner = 0; corner < 3; ++corner) take(corner);
      continue;
    }
    polygon.clear();
    for (std::uint32_t corner = 0; corner < face.num_indices; ++corner) {
      const ufbx_vec3 p = ufbx_get_vertex_vec3(&positions, face.index_begin + corner);
      polygon.emplace_back(p.x, p.y, p.z);
    }
    for (const auto& triangle : triangulate(polygon)) {
      for (const std::uint32_t corner : triangle) take(corner);
    }
  }
  if (corners.empty()) return std::nullopt;

  // Equal corners become one vertex.
  std::vector<std::uint32_t> numbers(corners.size());
  const ufbx_vertex_stream stream{corners.data(), corners.size(), sizeof(FbxCorner)};
  ufbx_error error;
  const std::size_t count =
      ufbx_generate_indices(&stream, 1, numbers.data(), numbers.size(), nullptr, &error);
  if (count == 0) throw Error(ErrorCode::internal, file + ": the vertices cannot be numbered");
  Primitive primitive;
  primitive.mesh_name = text_of(mesh.name);
  for (std::size_t i = 0; i < count; ++i) {
    primitive.positions.push_back(corners[i].position);
    if (normals.exists) primitive.normals.push_back(corners[i].normal);
    if (uvs.exists) primitive.uvs.push_back(corners[i].uv);
    if (has_colors) primitive.colors.push_back(corners[i].color);
  }
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
    primitive.triangles.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  }
  return primitive;
}

}  // namespace leafhull
