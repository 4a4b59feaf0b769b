// SPDX-License-Identifier: Apache-2.0
#include "foliage/surface_colour.h"

#include <algorithm>
#include <cmath>

#include "colour/colour.h"
#include "leaves/texels.h"

namespace leafhull {
namespace {

constexpr int kMostCells = 12;

Vec3f operator*(Vec3f a, Vec3f b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

/// Whether a colour is white or a grey that programs use as a default.
bool is_default(const std::array<float, 4>& color) {
  const auto [low, high] = std::minmax({color[0], color[1], color[2]});
  return high - low < 1e-3f && low > 0.55f;
}

}  // namespace

SurfaceColour::SurfaceColour(const TreeModel& tree, const Primitive& primitive, std::size_t samples)
    : primitive_(primitive) {
  if (primitive.material >= 0) material_ = &tree.materials[primitive.material];
  if (material_ && material_->base_color_image >= 0 && !primitive.uvs.empty()) {
    const Image& image = tree.images[material_->base_color_image];
    if (!image.empty()) image_ = &image;
  }
  if (material_ && material_->alpha_mode == AlphaMode::mask) cutoff_ = material_->alpha_cutoff;
  if (material_ && material_->alpha_mode != AlphaMode::opaque) alpha_ = material_->base_color[3];
  if (image_) {
    const double each = static_cast<double>(samples) /
                        static_cast<double>(std::max<std::size_t>(primitive.triangles.size(), 1));
    cells_ = std::clamp(static_cast<int>(std::sqrt(each)), 1, kMostCells);
  }
  is_known_ = varies() || (material_ && !is_default(material_->base_color));
}

Shown SurfaceColour::of(std::size_t triangle) const {
  const auto& corners = primitive_.triangles[triangle];
  const Vec3f factor = material_ ? Vec3f{material_->base_color[0], material_->base_color[1],
                                         material_->base_color[2]}
                                 : Vec3f{1, 1, 1};
  Vec3f sum;
  Vec3d lab_sum;
  double squares = 0;
  int kept = 0, count = 0;
  // At the middles of the cells of a grid over the triangle.
  for (int i = 0; i < cells_; ++i) {
    for (int j = 0; j < 2 * (cells_ - i) - 1; ++j) {
      const double third = j % 2 == 0 ? 1 / 3.0 : 2 / 3.0;
      const int half = j / 2;
      const double b = (i + third) / cells_, c = (half + third) / cells_, a = 1 - b - c;
      ++count;
      Vec3f colour = factor;
      const auto mix = [&](const auto& x, const auto& y, const auto& z) {
        return a * x + b * y + c * z;
      };
      if (!primitive_.colors.empty()) {
        const Vec3f* colors = primitive_.colors.data();
        const Vec3d mixed =
            mix(Vec3d(colors[corners[0]]), Vec3d(colors[corners[1]]), Vec3d(colors[corners[2]]));
        colour = colour * Vec3f(mixed);
      }
      if (image_ && material_) {  // an image is its material's
        const Vec2f* uvs = primitive_.uvs.data();
        const Vec2f p = uvs[corners[0]], q = uvs[corners[1]], r = uvs[corners[2]];
        const std::uint8_t* texel =
            texel_at(*image_, *material_, {mix(p.x, q.x, r.x), mix(p.y, q.y, r.y)});
        if (!texel || texel[3] * alpha_ < 255 * cutoff_) continue;
        colour = colour * Vec3f{linear_of_srgb(texel[0]), linear_of_srgb(texel[1]),
                                linear_of_srgb(texel[2])};
      }
      ++kept;
      sum = sum + colour;
      const Vec3d lab = oklab_of(colour);
      lab_sum = lab_sum + lab;
      squares += dot(lab, lab);
    }
  }
  if (kept == 0) return {.colour = factor, .kept = 0, .spread = 0};
  const Vec3d lab = lab_sum / static_cast<double>(kept);
  return {.colour = sum / static_cast<float>(kept),
          .kept = static_cast<double>(kept) / count,
          .spread = std::max(0.0, squares / kept - dot(lab, lab))};
}

}  // namespace leafhull
