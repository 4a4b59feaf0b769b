// SPDX-License-Identifier: Apache-2.0
#include "input/fbx/fbx_materials.h"

#include <array>

#include "input/fbx/fbx_text.h"
#include "input/images.h"
#include "input/input_error.h"

namespace leafhull {
namespace {

/// The first picture behind a map: a texture, or what a layered one or a shader is made of.
const ufbx_texture* file_of(const ufbx_texture* texture) {
  if (!texture) return nullptr;
  if (texture->type == UFBX_TEXTURE_FILE) return texture;
  return texture->file_textures.count > 0 ? texture->file_textures.data[0] : nullptr;
}

const ufbx_texture* first_of(std::initializer_list<const ufbx_material_map*> maps) {
  for (const ufbx_material_map* map : maps) {
    if (const ufbx_texture* file = file_of(map->texture)) return file;
  }
  return nullptr;
}

std::string name_of(const ufbx_texture* texture) {
  if (!texture) return {};
  std::string relative = text_of(texture->relative_filename);
  if (!relative.empty()) return relative;
  const std::string absolute = text_of(texture->absolute_filename);
  return absolute.empty() ? text_of(texture->name) : absolute;
}

Wrap wrap_of(ufbx_wrap_mode mode) { return mode == UFBX_WRAP_CLAMP ? Wrap::clamp : Wrap::repeat; }

}  // namespace

const ufbx_texture* FbxMaterials::colour_texture(const ufbx_material* material) {
  if (!material) return nullptr;
  return first_of({&material->pbr.base_color, &material->fbx.diffuse_color});
}

int FbxMaterials::use(const ufbx_material* material) {
  if (!material) return -1;
  const auto [entry, is_new] = numbers_.emplace(material, static_cast<int>(tree_.materials.size()));
  if (is_new) {
    tree_.materials.emplace_back();
    tree_.materials[entry->second] = read(*material);
  }
  return entry->second;
}

Material FbxMaterials::read(const ufbx_material& material) {
  Material read;
  read.name = text_of(material.name);
  const ufbx_texture* colour = colour_texture(&material);
  const ufbx_texture* opacity = first_of(
      {&material.pbr.opacity, &material.fbx.transparency_color, &material.fbx.transparency_factor});
  const ufbx_material_map& base = material.pbr.base_color;
  const ufbx_material_map& factor = material.pbr.base_factor;
  if (!colour && base.has_value) {  // a texture stands in its place
    const double scale = factor.has_value ? factor.value_real : 1;
    const std::array<double, 3> channels{base.value_vec3.x, base.value_vec3.y, base.value_vec3.z};
    for (int i = 0; i < 3; ++i)
      read.base_color[i] = static_cast<float>(share_of(scale * channels[i]));
  }
  const double alpha = material.pbr.opacity.has_value ? material.pbr.opacity.value_real : 1;
  if (!opacity && alpha > 0 && alpha < 1) {
    read.base_color[3] = static_cast<float>(alpha);
    read.alpha_mode = AlphaMode::blend;
  } else if (!opacity && alpha <= 0) {
    tree_.warnings.push_back("material " + in_quotes(read.name) +
                             " is transparent altogether; it is taken as opaque");
  }
  if (const ufbx_texture* shown = colour ? colour : opacity) {
    read.wrap_u = wrap_of(shown->wrap_u);
    read.wrap_v = wrap_of(shown->wrap_v);
    read.base_color_image = read_image(colour, opacity);
    judge_alpha(tree_.images[read.base_color_image], read, tree_.warnings);
  }
  return read;
}

int FbxMaterials::read_image(const ufbx_texture* colour, const ufbx_texture* opacity) {
  const std::pair names(name_of(colour), name_of(opacity));
  const auto [entry, is_new] = images_.emplace(names, static_cast<int>(tree_.images.size()));
  if (!is_new) return entry->second;
  Image image;
  if (colour) image = decode(*colour);
  if (opacity && names.first != names.second) {
    Image mask = decode(*opacity);
    if (!mask.empty()) image = with_opacity(image, std::move(mask));
  }
  image.name = colour ? names.first : names.second;
  tree_.images.push_back(std::move(image));
  return entry->second;
}

Image FbxMaterials::decode(const ufbx_texture& texture) {
  const std::string name = name_of(&texture);
  std::string reason;
  Image image;
  const ufbx_blob& content = texture.content;
  try {
    if (content.size > 0) {
      image = decode_image({static_cast<const std::uint8_t*>(content.data), content.size}, name,
                           reason);
    } else {
      image = decode_image(read_companion(companions_, name, tree_.warnings), name, reason);
    }
  } catch (const FileError& error) {
    reason = error.what();
  }
  keep_small(tree_.images, image, reason);
  if (!reason.empty()) tree_.warnings.push_back(in_quotes(name) + ": texture not read: " + reason);
  return image;
}

}  // namespace leafhull
