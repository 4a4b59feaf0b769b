// SPDX-License-Identifier: Apache-2.0
#include "render/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/light.h"

namespace leafhull::render {
namespace {

/// Two neighbouring texels along one axis and the weight of the second.
struct Texels {
  std::array<int, 2> index;
  float weight;

  Texels(float coordinate, int size, Wrap wrap) {
    float inside = coordinate;
    if (wrap == Wrap::repeat) inside -= std::floor(coordinate);
    if (wrap == Wrap::mirror) inside = std::abs(coordinate - 2 * std::floor((coordinate + 1) / 2));
    inside = inside > 0 ? std::min(inside, 1.0f) : 0;  // NaN becomes 0
    const float texel = inside * size - 0.5f;
    const int first = static_cast<int>(texel + 1) - 1, second = first + 1, last = size - 1;
    const bool around = wrap == Wrap::repeat;
    index = {first >= 0 ? first : around ? last : 0, second <= last ? second : around ? 0 : last};
    weight = texel - first;
  }
};

/// The texels around a point of an image, each with its weight.
template <class Function>
void for_each_texel(const Image& image, const Material& material, Vec2f uv, Function&& use) {
  const Texels column(uv.x, image.width, material.wrap_u);
  const Texels row(uv.y, image.height, material.wrap_v);
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const std::size_t texel =
          static_cast<std::size_t>(row.index[j]) * image.width + column.index[i];
      use(&image.rgba[4 * texel],
          (i ? column.weight : 1 - column.weight) * (j ? row.weight : 1 - row.weight));
    }
  }
}

}  // namespace

Vec3f base_color(const Material& material, const Image* image, Vec2f uv) {
  const std::array<float, 4>& factor = material.base_color;
  const Vec3f plain{factor[0], factor[1], factor[2]};
  if (!image) return plain;
  Vec3f sum;
  float total = 0;
  for_each_texel(*image, material, uv, [&](const std::uint8_t* rgba, float weight) {
    // Colours are weighted by their alpha: the colour of a hole must not bleed into the leaf.
    const float covered = weight * std::max<float>(rgba[3], 0.001f);
    sum = sum + Vec3f{linear(rgba[0]), linear(rgba[1]), linear(rgba[2])} * covered;
    total += covered;
  });
  return {plain.x * sum.x / total, plain.y * sum.y / total, plain.z * sum.z / total};
}

float alpha(const Material& material, const Image* image, Vec2f uv) {
  if (!image) return material.base_color[3];
  float sum = 0;
  for_each_texel(*image, material, uv,
                 [&](const std::uint8_t* rgba, float weight) { sum += weight * rgba[3]; });
  return material.base_color[3] * sum / 255;
}

}  // namespace leafhull::render
