// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "scene/scatter_row.h"
#include "text/text.h"

namespace leafhull {
namespace {

using nlohmann::json;

constexpr const char* kExample =
    R"(Write {"model": "tree.glb", "position": [x, y, z], "rotation": [x, y, z, w], "scale": s}.)";

/// NaN and infinities are not JSON. JavaScript writes them as null; Python writes their names,
/// which become null here.
std::string with_nulls(const std::string& line) {
  static constexpr std::array<std::string_view, 3> kNames{"NaN", "-Infinity", "Infinity"};
  std::string text;
  bool in_string = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const std::string_view rest = std::string_view(line).substr(at);
    const auto name = in_string ? kNames.end() : std::ranges::find_if(kNames, [&](auto candidate) {
      return rest.starts_with(candidate);
    });
    if (name != kNames.end()) {
      text += "null";
      at += name->size() - 1;
      continue;
    }
    if (line[at] == '"') in_string = !in_string;
    text += line[at];
    if (in_string && line[at] == '\\' && at + 1 < line.size()) text += line[++at];
  }
  return text;
}

json object_in(const std::string& line) {
  json value = json::parse(line, nullptr, false);
  if (value.is_discarded()) value = json::parse(with_nulls(line), nullptr, false);
  if (!value.is_object()) throw BadRow{"is not a JSON object", kExample};
  return value;
}

bool is_number(const json& value) { return value.is_number() || value.is_null(); }

double number(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

bool are_numbers(const json& value, std::size_t count) {
  return value.is_array() && value.size() == count && std::ranges::all_of(value, is_number);
}

Vec3d vec3(const json& list) { return {number(list[0]), number(list[1]), number(list[2])}; }

std::string model_of(const json& value) {
  if (!value.is_string()) throw BadRow{"its model is not text", kExample};
  return value.get<std::string>();
}

Vec3d position_of(const json& value) {
  if (!are_numbers(value, 3)) throw BadRow{"its position is not three numbers", kExample};
  return vec3(value);
}

Rotation rotation_of(const json& value) {
  if (is_number(value)) return rotation_of_yaw(number(value));
  if (are_numbers(value, 3)) return rotation_of_angles(vec3(value));
  if (!are_numbers(value, 4)) {
    throw BadRow{"its rotation is not one, three or four numbers",
                 "Give a quaternion [x, y, z, w], [rx, ry, rz] in degrees, or degrees about y."};
  }
  return {number(value[0]), number(value[1]), number(value[2]), number(value[3])};
}

Vec3d scale_of(const json& value) {
  if (is_number(value)) return {number(value), number(value), number(value)};
  if (!are_numbers(value, 3)) throw BadRow{"its scale is not one or three numbers", kExample};
  return vec3(value);
}

}  // namespace

bool JsonRows::read(std::string& line, ScatterRow& row) {
  const json object = object_in(line);
  row = {};
  for (const char* name : {"model", "position"}) {
    if (!object.contains(name)) throw BadRow{std::string("has no ") + name, kExample};
  }
  for (const auto& [name, value] : object.items()) {
    if (name == "model") {
      row.model = model_of(value);
    } else if (name == "position") {
      row.position = position_of(value);
    } else if (name == "rotation") {
      row.rotation = rotation_of(value);
    } else if (name == "scale") {
      row.scale = scale_of(value);
    } else {
      unknown_.insert('"' + printable(name) + '"');
    }
  }
  return true;
}

}  // namespace leafhull
