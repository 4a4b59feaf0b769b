// SPDX-License-Identifier: Apache-2.0
#include "input/obj_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "colour/colour.h"
#include "input/input_error.h"
#include "input/obj_text.h"

namespace leafhull {
namespace {

constexpr std::array<std::string_view, 5> kUnread{"p", "l", "curv", "curv2", "surf"};

double take_number(std::string_view& line) { return finite_number(take_word(line)); }

Vec3d take_vec3(std::string_view& line) {
  const double x = take_number(line), y = take_number(line), z = take_number(line);
  return {x, y, z};
}

bool is_blank(std::string_view line) { return take_word(line).empty(); }

/// Red, green and blue after a position, which some programs write.
void take_color(std::string_view line, ObjVertices& vertices) {
  const Vec3d color = take_vec3(line);
  const auto is_share = [](double x) { return x >= 0 && x <= 1; };
  const bool is_color = is_share(color.x) && is_share(color.y) && is_share(color.z);
  if (is_color && vertices.colors.size() + 1 == vertices.positions.size()) {
    vertices.colors.push_back(
        Vec3f(Vec3d(linear_of_srgb(color.x), linear_of_srgb(color.y), linear_of_srgb(color.z))));
  }
}

Vec2d take_uv(std::string_view& line) {
  const double u = take_number(line);
  return {u, is_blank(line) ? 0 : take_number(line)};
}

}  // namespace

ObjVertices read_obj_vertices(std::string_view text, const std::string& file,
                              std::vector<std::string>& warnings) {
  ObjVertices vertices;
  std::size_t bad_normals = 0, bad_uvs = 0, unread = 0;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = take_line(text);
    std::string_view rest = line;
    const std::string_view keyword = take_word(rest);
    if (keyword == "v") {
      const Vec3d p = take_vec3(rest);
      if (std::isnan(p.x + p.y + p.z)) {
        input_error(file, "line " + std::to_string(number),
                    in_quotes(line) + " is not a vertex of finite numbers", kRepairMesh);
      }
      vertices.positions.push_back(p);
      take_color(rest, vertices);
    } else if (keyword == "vn" && !rest.empty()) {
      const Vec3d n = take_vec3(rest);
      bad_normals += std::isnan(n.x + n.y + n.z);
      vertices.normals.push_back(Vec3f(n));
    } else if (keyword == "vt" && !rest.empty()) {
      const Vec2d uv = take_uv(rest);
      bad_uvs += std::isnan(uv.x + uv.y);
      vertices.uvs.push_back(uv);
    } else {
      unread += std::ranges::find(kUnread, keyword) != kUnread.end();
    }
  }
  if (vertices.colors.size() < vertices.positions.size()) vertices.colors.clear();
  if (unread > 0) {
    warnings.push_back(std::to_string(unread) + " points, lines or curves are passed over");
  }
  if (bad_normals > 0) warnings.push_back("vn: " + std::string(kNotAllFinite));
  if (bad_uvs > 0) warnings.push_back("vt: " + std::string(kNotAllFinite));
  return vertices;
}

}  // namespace leafhull
