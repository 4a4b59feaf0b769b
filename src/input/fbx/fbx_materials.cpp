// SPDX-License-Identifier: Apache-2.0
#include "input/fbx/fbx_materials.h"

#include <array>

#include "input/fbx/fbx_text.h"
#include "input/images.h"
#include "input/input_error.h"

namespace leafhull {
namespace {

/// The first picture of a texture, which may be a file, layers or a shader.
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
  std::string absolute = text_of(texture->absolute_filename);
  if (!absolute.empty()) return absolute;
  std::string own = text_of(texture->name);
  return own.empty() ? "texture " + std::to_string(texture->typed_id) : own;
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
                             " is fully transparent; it is taken as opaque");
  }
  if (const ufbx_texture* shown = colour ? colour : opacity) {
    read.wrap_u = wrap_of(shown->wrap_u);
    read.wrap_v = wrap_of(shown->wrap_v);
    const ImageNames names(name_of(colour), name_of(opacity));
    const auto source = [&](const std::string& name) {
      return load(name == names.first ? *colour : *opacity);
    };
    read.base_color_image = images_.number_of(names, source, tree_);
  }
  return read;
}

ImageSource FbxMaterials::load(const ufbx_texture& texture) {
  const ufbx_blob& content = texture.content;
  const std::string name = name_of(&texture);
  if (content.size == 0) return companion_image(companions_, name, tree_.warnings);
  return {.name = name,
          .place = in_quotes(name),
          .lent = {static_cast<const std::uint8_t*>(content.data), content.size}};
}

void FbxMaterials::decode_images() {
  images_.decode(tree_);
  for (Material& material : tree_.materials) judge_alpha(tree_, material);
}

}  // namespace leafhull
