// SPDX-License-Identifier: Apache-2.0
#include "watercolour/strokes.h"

#include <algorithm>
#include <cmath>

#include "render/sampling.h"

namespace leafhull::watercolour {
namespace {

float smooth(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

/// The two half-axes of a dab: at least `least` long and three tenths as wide.
struct Dab {
  Vec2f along, across;  ///< unit
  float length, width;
};

Dab dab(const Stroke& stroke, const Brush& brush) {
  Vec2f major = stroke.half_major, minor = stroke.half_minor;
  const auto norm = [](Vec2f v) { return std::hypot(v.x, v.y); };
  if (norm(minor) > norm(major)) std::swap(major, minor);
  const float length = norm(major);
  const Vec2f along = length > 0 ? Vec2f{major.x / length, major.y / length} : Vec2f{1, 0};
  const float half = std::max(brush.size * length, brush.least);
  return {along, {-along.y, along.x}, half, std::max(brush.size * norm(minor), 0.38f * half)};
}

/// How much of a pixel a leaf covers: two arcs that meet in its tips.
float coverage(const Dab& dab, float dx, float dy) {
  const float u = (dx * dab.along.x + dy * dab.along.y) / dab.length;
  const float v = std::abs(dx * dab.across.x + dy * dab.across.y);
  return std::clamp((1 - u * u) * dab.width - v + 0.5f, 0.0f, 1.0f);
}

}  // namespace

std::vector<float> paint_leaves(std::span<const Stroke> strokes, const Room& room,
                                const Brush& brush) {
  const int width = room.width, height = room.height;
  std::vector<float> cover(static_cast<std::size_t>(width) * height);
  for (const Stroke& stroke : strokes) {
    const float chance = unit(render::hash(stroke.leaf * 2 + 1));
    if (chance >= brush.detail) continue;
    const float cx = std::floor(stroke.centre.x), cy = std::floor(stroke.centre.y);
    if (!(cx >= 0 && cy >= 0 && cx < static_cast<float>(width) &&
          cy < static_cast<float>(height))) {
      continue;
    }
    const std::size_t at = static_cast<std::size_t>(cy) * width + static_cast<std::size_t>(cx);
    if (stroke.depth > room.depth[at] + brush.tolerance) continue;
    const float edge = 1 - smooth(0.5f, 0.95f, room.outline[at]);
    const float light = smooth(0.3f, 0.7f, 1 - room.dark[at]);
    const float wanted = brush.detail * std::max(edge, 0.35f * light);
    const float opacity =
        smooth(0, 0.1f, wanted - chance) * (0.65f + 0.35f * unit(render::hash(stroke.leaf * 2)));
    if (opacity <= 0) continue;

    const Dab leaf = dab(stroke, brush);
    const float reach = std::max(leaf.length, leaf.width) + 1;
    const int left = std::max(0, static_cast<int>(stroke.centre.x - reach));
    const int right = std::min(width - 1, static_cast<int>(stroke.centre.x + reach));
    const int top = std::max(0, static_cast<int>(stroke.centre.y - reach));
    const int bottom = std::min(height - 1, static_cast<int>(stroke.centre.y + reach));
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const float c = coverage(leaf, static_cast<float>(x) + 0.5f - stroke.centre.x,
                                 static_cast<float>(y) + 0.5f - stroke.centre.y);
        float& pixel = cover[static_cast<std::size_t>(y) * width + x];
        pixel = std::max(pixel, opacity * c);
      }
    }
  }
  return cover;
}

}  // namespace leafhull::watercolour
