// SPDX-License-Identifier: Apache-2.0
#include "input/obj_materials.h"

#include <algorithm>
#include <sstream>
#include <tuple>
#include <utility>

#include "input/file_bytes.h"
#include "input/images.h"
#include "input/input_error.h"

namespace leafhull {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// The rest of every line that begins with `keyword`.
std::vector<std::string> arguments(std::string_view obj, std::string_view keyword) {
  std::vector<std::string> found;
  while (!obj.empty()) {
    const std::string_view line = trimmed(obj.substr(0, obj.find('\n')));
    obj.remove_prefix(std::min(obj.find('\n'), obj.size() - 1) + 1);
    if (line.starts_with(keyword) && line.size() > keyword.size() &&
        (line[keyword.size()] == ' ' || line[keyword.size()] == '\t')) {
      found.emplace_back(trimmed(line.substr(keyword.size())));
    }
  }
  return found;
}

/// @throws FileError.
Bytes read_companion(const Companions& companions, const std::string& name,
                     std::vector<std::string>& warnings) {
  const Companions::Found found = companions.find(name);
  Bytes bytes = read_file(found.path);
  if (!found.note.empty()) warnings.push_back(found.note);
  return bytes;
}

/// An image beside the file; empty, with a warning, where it cannot be read.
Image read_image(const std::string& name, const Companions& companions,
                 std::vector<std::string>& warnings) {
  std::string reason;
  Image image;
  try {
    image = decode_image(read_companion(companions, name, warnings), name, reason);
  } catch (const FileError& error) {
    reason = error.what();
  }
  if (!reason.empty()) warnings.push_back(in_quotes(name) + ": texture not read: " + reason);
  return image;
}

}  // namespace

ObjMaterials read_material_libraries(std::string_view obj, const Companions& companions,
                                     std::vector<std::string>& warnings) {
  ObjMaterials result;
  for (const std::string& name : arguments(obj, "mtllib")) {
    try {
      const Bytes bytes = read_companion(companions, name, warnings);
      std::istringstream stream{std::string(text_of(bytes))};
      std::string warning, error;
      tinyobj_double::LoadMtl(&result.by_name, &result.materials, &stream, &warning, &error);
    } catch (const FileError& error) {
      warnings.push_back("mtllib " + in_quotes(name) + " not read: " + error.what());
    }
  }
  return result;
}

int ObjMaterials::find_or_add(const std::string& name) {
  const auto [entry, is_new] = by_name.emplace(name, static_cast<int>(materials.size()));
  if (is_new) {
    tinyobj_double::material_t& material = materials.emplace_back();
    material.name = name;
    material.dissolve = 1;
    std::fill_n(material.diffuse, 3, tinyobj_double::real_t(1));
    material.diffuse_texopt.clamp = false;
    std::fill_n(material.diffuse_texopt.scale, 3, tinyobj_double::real_t(1));
    std::fill_n(material.diffuse_texopt.origin_offset, 3, tinyobj_double::real_t(0));
    material.alpha_texopt = material.diffuse_texopt;
  }
  return entry->second;
}

void add_materials(const ObjMaterials& from, const std::vector<bool>& used,
                   const Companions& companions, TreeModel& tree) {
  std::map<std::pair<std::string, std::string>, int> images;  // by map_Kd and map_d
  for (std::size_t i = 0; i < from.materials.size(); ++i) {
    const tinyobj_double::material_t& source = from.materials[i];
    Material& material = tree.materials.emplace_back();
    material.name = source.name;
    for (int c = 0; c < 3; ++c) material.base_color[c] = static_cast<float>(source.diffuse[c]);
    material.base_color[3] = static_cast<float>(source.dissolve);
    if (!source.alpha_texname.empty()) {
      material.alpha_mode = AlphaMode::mask;
    } else if (source.dissolve < 1) {
      material.alpha_mode = AlphaMode::blend;
    }
    if (source.diffuse_texopt.clamp) material.wrap_u = material.wrap_v = Wrap::clamp;

    const auto& [color, alpha] = std::tie(source.diffuse_texname, source.alpha_texname);
    if (!used[i] || (color.empty() && alpha.empty())) continue;
    const auto [entry, is_new] =
        images.emplace(std::pair(color, alpha), static_cast<int>(tree.images.size()));
    material.base_color_image = entry->second;
    if (!is_new) continue;
    Image image;
    if (!color.empty()) image = read_image(color, companions, tree.warnings);
    if (!alpha.empty() && alpha != color) {
      Image mask = read_image(alpha, companions, tree.warnings);
      if (!mask.empty()) image = with_opacity(image, std::move(mask));
    }
    image.name = color.empty() ? alpha : color;
    tree.images.push_back(std::move(image));
  }
}

Vec2f image_coordinates(const tinyobj_double::material_t& material, double u, double v) {
  const tinyobj_double::texture_option_t& map =
      material.diffuse_texname.empty() ? material.alpha_texopt : material.diffuse_texopt;
  return {static_cast<float>(u * map.scale[0] + map.origin_offset[0]),
          static_cast<float>(1 - (v * map.scale[1] + map.origin_offset[1]))};
}

}  // namespace leafhull
