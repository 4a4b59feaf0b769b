// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "input/file_bytes.h"
#include "input/gltf_file.h"
#include "input/gltf_nodes.h"
#include "input/input_error.h"
#include "leafhull/render.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

using nlohmann::json;

constexpr double kLeastAngle = 0.1, kLargestAngle = 170;
constexpr double kDegree = std::numbers::pi / 180;
constexpr std::string_view kLikeThis =
    R"(Give an object such as {"eye": [0, 5, 20], "target": [0, 5, 0], "angle": 30}.)";
constexpr std::string_view kGiveCamera =
    "Give a .json camera, or a .glb or .gltf file with a perspective camera in its scene.";

/// The names of a camera's parts in its file, for messages.
struct Places {
  std::string eye, target, up, angle;
};

void check(const View& view, const std::string& file, const Places& places) {
  const auto fail = [&](const std::string& place, std::string_view what, std::string_view remedy) {
    input_error(file, place, what, remedy);
  };
  const auto is_finite = [](Vec3d v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  constexpr std::string_view kGiveNumbers = "Give plain numbers, in the model's units.";
  if (!is_finite(view.eye)) fail(places.eye, "is not finite", kGiveNumbers);
  if (!is_finite(view.target)) fail(places.target, "is not finite", kGiveNumbers);
  if (!is_finite(view.up)) fail(places.up, "is not finite", kGiveNumbers);
  const Vec3d forward = view.target - view.eye;
  if (!(length(forward) > 0)) {
    fail(places.target, "is at the eye", "Give a target that the camera can look at.");
  }
  if (!(length(cross(normalized(forward), normalized(view.up))) > 1e-6)) {
    fail(places.up, "does not say which way is up: it is zero, or along the way the camera looks",
         "Give another up, such as [0, 1, 0], or [0, 0, -1] for a camera that looks down.");
  }
  if (view.angle < kLeastAngle || view.angle > kLargestAngle) {
    fail(places.angle, "is not from 0.1 to 170 degrees",
         "Give the angle of view from the picture's bottom to its top.");
  }
}

Vec3d vector_of(const json& value, const std::string& file, const std::string& key) {
  const auto is_number = [](const json& entry) { return entry.is_number(); };
  if (!value.is_array() || value.size() != 3 || !std::ranges::all_of(value, is_number)) {
    input_error(file, key, "is not a list of three numbers", kLikeThis);
  }
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

View read_json(std::string_view text, const std::string& file) {
  const json camera = json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!camera.is_object()) input_error(file, "", "is not a JSON object", kLikeThis);
  for (const char* key : {"eye", "target"}) {
    if (!camera.contains(key)) input_error(file, key, "is missing", kLikeThis);
  }
  View view;
  for (const auto& [key, value] : camera.items()) {
    if (key == "eye") {
      view.eye = vector_of(value, file, key);
    } else if (key == "target") {
      view.target = vector_of(value, file, key);
    } else if (key == "up") {
      view.up = vector_of(value, file, key);
    } else if (key == "angle") {
      if (!value.is_number()) input_error(file, key, "is not a number", kLikeThis);
      view.angle = value;
    } else {
      input_error(file, printable(key), "is not a key of a camera",
                  "They are eye, target, up and angle.");
    }
  }
  check(view, file, {"eye", "target", "up", "angle"});
  return view;
}

/// A camera of glTF looks along its node's -z. Source: glTF 2.0, 3.10.
View read_node(ByteSpan bytes, const std::filesystem::path& path, bool allow_outside) {
  const GltfFile file = open_gltf(bytes, path.string(), Companions(path, allow_outside));
  const std::vector<PlacedCamera> placed = place_cameras(file);
  const auto found = std::ranges::find_if(placed, [&](const PlacedCamera& camera) {
    return file.cameras[camera.camera].type == "perspective";
  });
  if (found == placed.end()) file.fail("", "has no perspective camera in its scene", kGiveCamera);
  const auto& [camera, place, m] = *found;
  const auto column = [&m = m](int i) { return Vec3d{m[0][i], m[1][i], m[2][i]}; };
  View view;
  view.eye = column(3);
  view.target = view.eye - normalized(column(2));
  view.up = column(1);
  view.angle = file.cameras[camera].angle / kDegree;
  check(view, file.name, {place, place, place, place_of("cameras", camera) + ", yfov"});
  return view;
}

}  // namespace

View read_view(const std::filesystem::path& path, const ReadOptions& options) {
  const Bytes bytes = read_named_file(path, kGiveCamera);
  const bool is_gltf = lower_extension(path) == ".gltf" || text_of(bytes).starts_with("glTF");
  return is_gltf ? read_node(bytes, path, options.allow_outside)
                 : read_json(text_of(bytes), path.string());
}

}  // namespace leafhull
