// SPDX-License-Identifier: Apache-2.0
#include "input/obj_materials.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <utility>

#include "input/file_bytes.h"
#include "input/image_table.h"
#include "input/images.h"
#include "input/input_error.h"
#include "input/obj_text.h"
#include "text/file_name.h"

namespace leafhull {
namespace {

/// The rest of every line that begins with `keyword`.
std::vector<std::string> arguments(std::string_view obj, std::string_view keyword) {
  std::vector<std::string> found;
  while (!obj.empty()) {
    std::string_view line = take_line(obj);
    if (take_word(line) == keyword && !trimmed(line).empty()) found.emplace_back(trimmed(line));
  }
  return found;
}

bool is_there(const Companions& companions, const std::string& name) try {
  return companions.find(name).note.empty();
} catch (const FileError&) {
  return false;
}

/// The names on a mtllib line: the whole line if it names a file, else each ends in .mtl. Both may
/// hold blanks.
std::vector<std::string> library_names(const std::string& line, const Companions& companions) {
  std::vector<std::string> names(1);
  std::string_view rest = line;
  for (std::string_view word; !(word = take_word(rest)).empty();) {
    if (lower_extension(names.back()) == ".mtl") names.emplace_back();
    (names.back() += names.back().empty() ? "" : " ") += word;
  }
  if (names.size() == 1 || is_there(companions, line)) return {line};
  return names;
}

std::string quoted_list(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 3;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
    list += (i > 0 ? ", " : "") + in_quotes(names[i]);
  }
  if (names.size() > kMost) list += " and " + std::to_string(names.size() - kMost) + " more";
  return list;
}

/// A material's parameter, or NaN if it is missing. Words such as -halo may precede the number.
double parameter(const tinyobj_double::material_t& material, const char* key) {
  const auto found = material.unknown_parameter.find(key);
  if (found == material.unknown_parameter.end()) return std::nan("");
  const std::string_view value = trimmed(found->second);
  return finite_number(value.substr(value.find_last_of(" \t") + 1));
}

/// The opacity of a material; none if it contradicts itself.
std::optional<double> opacity_of(const tinyobj_double::material_t& material) {
  const double d = parameter(material, kDissolve), tr = parameter(material, kTransparency);
  const double opacity = !std::isnan(d) ? d : !std::isnan(tr) ? 1 - tr : 1;
  const bool at_odds = std::abs(d + tr - 1) > 0.01 ||  // false where one is NaN
                       (opacity <= 0 && !material.alpha_texname.empty());
  return at_odds ? std::nullopt : std::optional(std::clamp(opacity, 0.0, 1.0));
}

/// Sets opacities. Exporters disagree about the meaning of d and Tr, so implausible values count as
/// opaque.
void set_opacities(std::span<tinyobj_double::material_t> library, const std::string& name,
                   std::vector<std::string>& warnings) {
  std::vector<std::string> at_odds;
  for (tinyobj_double::material_t& material : library) {
    const std::optional<double> opacity = opacity_of(material);
    if (!opacity) at_odds.push_back(material.name);
    material.dissolve = opacity.value_or(1);
  }
  if (!at_odds.empty()) {
    warnings.push_back(in_quotes(name) + ": d, Tr and map_d contradict each other, taken as " +
                       "opaque: " + quoted_list(at_odds));
  }
  if (std::ranges::all_of(library, [](const auto& material) { return material.dissolve == 0; })) {
    for (tinyobj_double::material_t& material : library) material.dissolve = 1;
    warnings.push_back(in_quotes(name) + ": d and Tr make every material fully transparent; all " +
                       "are taken as opaque");
  }
}

/// Gives each material a white default Kd. Without one tinyobjloader takes black, or grey beside a
/// texture, though programs mean the texture unchanged.
std::string white_unless_told(std::string_view library) {
  std::string text;
  while (!library.empty()) {
    const std::string_view line = take_line(library);
    text.append(line).append("\n");
    if (line.starts_with("newmtl ")) text += "Kd 1 1 1\n";
  }
  return text;
}

}  // namespace

ObjMaterials read_material_libraries(std::string_view obj, const Companions& companions,
                                     std::vector<std::string>& warnings) {
  std::vector<std::string> names;
  std::set<std::string> lines, known;
  for (const std::string& line : arguments(obj, "mtllib")) {
    if (!lines.insert(line).second) continue;
    for (std::string& name : library_names(line, companions)) {
      if (known.insert(name).second) names.push_back(std::move(name));
    }
  }
  ObjMaterials result;
  for (const std::string& name : names) {
    try {
      const Bytes bytes = read_companion(companions, name, warnings);
      result.add_library(text_of(bytes), name, warnings);
    } catch (const FileError& error) {
      warnings.push_back("mtllib " + in_quotes(name) + " not read: " + error.what());
    }
  }
  return result;
}

void ObjMaterials::add_library(std::string_view written, const std::string& name,
                               std::vector<std::string>& warnings) {
  std::istringstream stream(white_unless_told(obj_text(written)));
  std::string warning, error;
  tinyobj_double::LoadMtl(&by_name, &materials, &stream, &warning, &error);
  set_opacities(std::span(materials).subspan(in_libraries), name, warnings);
  in_libraries = materials.size();
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
  ImageTable images;
  std::vector<std::string> unknown;
  for (std::size_t i = 0; i < from.materials.size(); ++i) {
    const tinyobj_double::material_t& source = from.materials[i];
    Material& material = tree.materials.emplace_back();
    material.name = source.name;
    for (int c = 0; c < 3; ++c)
      material.base_color[c] = static_cast<float>(share_of(source.diffuse[c]));
    material.base_color[3] = static_cast<float>(source.dissolve);
    if (!source.alpha_texname.empty()) {
      material.alpha_mode = AlphaMode::mask;
    } else if (source.dissolve < 1) {
      material.alpha_mode = AlphaMode::blend;
    }
    if (source.diffuse_texopt.clamp) material.wrap_u = material.wrap_v = Wrap::clamp;

    if (!used[i]) continue;
    if (from.in_libraries > 0 && i >= from.in_libraries) unknown.push_back(source.name);
    const ImageNames names(source.diffuse_texname, source.alpha_texname);
    if (names == ImageNames()) continue;
    const auto load = [&](const std::string& name) {
      return companion_image(companions, name, tree.warnings);
    };
    material.base_color_image = images.number_of(names, load, tree);
  }
  images.decode(tree);
  for (Material& material : tree.materials) judge_alpha(tree, material);
  if (!unknown.empty()) {
    tree.warnings.push_back("no material library has " + quoted_list(unknown));
  }
}

Vec2f image_coordinates(const tinyobj_double::material_t& material, double u, double v) {
  const tinyobj_double::texture_option_t& map =
      material.diffuse_texname.empty() ? material.alpha_texopt : material.diffuse_texopt;
  return {static_cast<float>(u * map.scale[0] + map.origin_offset[0]),
          static_cast<float>(1 - (v * map.scale[1] + map.origin_offset[1]))};
}

}  // namespace leafhull
