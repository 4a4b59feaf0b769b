// SPDX-License-Identifier: Apache-2.0
#include "input/gltf_materials.h"

#include <algorithm>
#include <cmath>

#include "input/gltf_accessor.h"
#include "leafhull/error.h"

namespace leafhull {
namespace {

double number(const tinygltf::Value& list, int index, double missing) {
  const tinygltf::Value& value = list.Get(index);
  return value.IsNumber() ? value.GetNumberAsDouble() : missing;
}

Vec2d vec2(const tinygltf::Value& object, const std::string& key, Vec2d missing) {
  const tinygltf::Value& list = object.Get(key);
  if (!list.IsArray()) return missing;
  return {number(list, 0, missing.x), number(list, 1, missing.y)};
}

TextureMapping mapping_of(int set, const tinygltf::Value* transform) {
  TextureMapping mapping{.set = set};
  if (!transform) return mapping;
  mapping.set = integer(*transform, "texCoord", set);
  mapping.offset = vec2(*transform, "offset", {0, 0});
  mapping.scale = vec2(*transform, "scale", {1, 1});
  const tinygltf::Value& rotation = transform->Get("rotation");
  if (rotation.IsNumber()) mapping.rotation = rotation.GetNumberAsDouble();
  return mapping;
}

AlphaMode alpha_mode(const std::string& mode) {
  if (mode == "MASK") return AlphaMode::mask;
  return mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
}

Wrap wrap(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
  return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

// A texture may name an image in a common format, one in a rarer format, or both.
int source_of(const tinygltf::Texture& texture) {
  if (texture.source >= 0) return texture.source;
  for (const char* name : {"EXT_texture_webp", "KHR_texture_basisu"}) {
    if (const auto* extension = find_extension(texture.extensions, name)) {
      return integer(*extension, "source", -1);
    }
  }
  return -1;
}

}  // namespace

void TextureMapping::apply(std::vector<Vec2f>& uvs) const {
  if (is_identity()) return;
  const double c = std::cos(rotation), s = std::sin(rotation);
  for (Vec2f& uv : uvs) {
    const double u = scale.x * uv.x, v = scale.y * uv.y;
    uv = {static_cast<float>(offset.x + c * u + s * v),
          static_cast<float>(offset.y - s * u + c * v)};
  }
}

void MaterialReader::read_all() {
  for (const tinygltf::Material& from : file_.model.materials) {
    Material& to = tree_.materials.emplace_back();
    to.name = from.name;
    to.alpha_mode = alpha_mode(from.alphaMode);
    to.alpha_cutoff = from.alphaCutoff;
    base_colors_.push_back(read_base_color(from, to));
  }
}

MaterialReader::BaseColor MaterialReader::read_base_color(const tinygltf::Material& from,
                                                          Material& to) const {
  const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
  const auto* glossy = find_extension(from.extensions, "KHR_materials_pbrSpecularGlossiness");
  const bool has_diffuse =
      glossy && (glossy->Has("diffuseTexture") || glossy->Has("diffuseFactor"));
  if (!has_diffuse || pbr.baseColorTexture.index >= 0) {
    std::ranges::copy(pbr.baseColorFactor, to.base_color.begin());
    return {pbr.baseColorTexture.index,
            mapping_of(pbr.baseColorTexture.texCoord,
                       find_extension(pbr.baseColorTexture.extensions, "KHR_texture_transform"))};
  }
  const tinygltf::Value& factor = glossy->Get("diffuseFactor");
  if (factor.IsArray()) {
    for (int i = 0; i < 4; ++i) to.base_color[i] = static_cast<float>(number(factor, i, 1));
  }
  const tinygltf::Value& texture = glossy->Get("diffuseTexture");
  if (!texture.IsObject()) return {};
  const tinygltf::Value& extensions = texture.Get("extensions");
  const bool transformed = extensions.Has("KHR_texture_transform");
  return {integer(texture, "index", -1),
          mapping_of(integer(texture, "texCoord", 0),
                     transformed ? &extensions.Get("KHR_texture_transform") : nullptr)};
}

TextureMapping MaterialReader::use(int index, const std::string& user) {
  if (index < 0) return {};
  if (!is_index(index, tree_.materials.size())) {
    file_.fail(user, "there is no " + place_of("materials", index));
  }
  Material& material = tree_.materials[index];
  const BaseColor& base_color = base_colors_[index];
  if (base_color.texture >= 0 && material.base_color_image < 0) {
    material.base_color_image =
        image_of(base_color.texture, material, place_of("materials", index));
  }
  return base_color.mapping;
}

int MaterialReader::image_of(int index, Material& material, const std::string& place) {
  const tinygltf::Model& model = file_.model;
  if (!is_index(index, model.textures.size())) {
    file_.fail(place, "there is no " + place_of("textures", index));
  }
  const tinygltf::Texture& texture = model.textures[index];
  if (is_index(texture.sampler, model.samplers.size())) {
    const tinygltf::Sampler& sampler = model.samplers[texture.sampler];
    material.wrap_u = wrap(sampler.wrapS);
    material.wrap_v = wrap(sampler.wrapT);
  }
  return image_number(source_of(texture), place_of("textures", index));
}

int MaterialReader::image_number(int index, const std::string& texture) {
  const std::string name = index < 0 ? "none" : place_of("images", index);
  const std::string& place = index < 0 ? texture : name;
  return images_.number_of(
      {name, {}}, [&](const std::string&) { return load_image(index, place); }, tree_);
}

ImageSource MaterialReader::load_image(int index, const std::string& place) {
  ImageSource image{.place = place};
  if (!is_index(index, file_.model.images.size())) {
    image.fault = index < 0 ? "it names no image" : "there is no such image";
    return image;
  }
  const tinygltf::Image& source = file_.model.images[index];
  image.name = source.uri.starts_with("data:") || source.uri.empty() ? source.name : source.uri;
  try {
    if (source.bufferView >= 0) {
      image.lent = view_bytes(file_, source.bufferView, place);
    } else if (source.uri.empty()) {
      image.fault = "it has neither a uri nor a bufferView";
    } else {
      image.load = uri_loader(file_, source.uri, place);
    }
  } catch (const Error& error) {
    image.fault = error.what();
  }
  return image;
}

}  // namespace leafhull
