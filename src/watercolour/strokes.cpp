// SPDX-License-Identifier: Apache-2.0
#include "watercolour/strokes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/sampling.h"

namespace leafhull::watercolour {
namespace {

constexpr float kLeastWidth = 0.38f;  // of a stroke's length: leaves on edge are not hairs

float smooth(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// One of a leaf's chances, 0..1.
float chance(const Stroke& stroke, std::uint32_t which) {
  return static_cast<float>(render::hash(stroke.leaf * 3 + which) >> 8) * 0x1p-24f;
}

/// A leaf's outline: two arcs that meet in its tips.
struct Dab {
  Vec2f centre, along;  ///< along: unit
  float length, width;  ///< half of each

  Dab(const Stroke& stroke, const Brush& brush) : centre(stroke.centre) {
    Vec2f major = stroke.half_major, minor = stroke.half_minor;
    const auto norm = [](Vec2f v) { return std::hypot(v.x, v.y); };
    if (norm(minor) > norm(major)) std::swap(major, minor);
    const float norm_major = norm(major);
    along = norm_major > 0 ? Vec2f{major.x / norm_major, major.y / norm_major} : Vec2f{1, 0};
    length = std::max(brush.size * norm_major, brush.least);
    width = std::max(brush.size * norm(minor), kLeastWidth * length);
  }

  /// How much of the pixel around (x, y) it covers, about.
  float coverage(float x, float y) const {
    const float dx = x - centre.x, dy = y - centre.y;
    const float u = (dx * along.x + dy * along.y) / length;
    const float v = std::abs(dy * along.x - dx * along.y);
    return std::clamp((1 - u * u) * width - v + 0.5f, 0.0f, 1.0f);
  }
};

/// The pixel under a stroke's centre if the stroke is in the picture and not hidden.
std::optional<std::size_t> seen_at(const Stroke& stroke, const Room& room, const Brush& brush) {
  const Vec2f c = stroke.centre;
  const auto width = static_cast<float>(room.width), height = static_cast<float>(room.height);
  if (!(c.x >= 0 && c.y >= 0 && c.x < width && c.y < height)) return std::nullopt;
  const std::size_t at = static_cast<std::size_t>(c.y) * room.width + static_cast<std::size_t>(c.x);
  if (!(stroke.depth <= room.depth[at] + brush.tolerance)) return std::nullopt;
  return at;
}

/// Calls touch(pixel, coverage) for the pixels of a dab.
template <class Touch>
void cover(const Dab& dab, const Room& room, Touch&& touch) {
  const float reach = std::max(dab.length, dab.width) + 1;
  const auto clip = [](float x, int end) {
    return static_cast<int>(std::clamp(x, 0.0f, static_cast<float>(end)));
  };
  const int left = clip(dab.centre.x - reach, room.width);
  const int right = clip(dab.centre.x + reach + 1, room.width);
  const int top = clip(dab.centre.y - reach, room.height);
  const int bottom = clip(dab.centre.y + reach + 1, room.height);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const float c = dab.coverage(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      if (c > 0) touch(static_cast<std::size_t>(y) * room.width + x, c);
    }
  }
}

}  // namespace

std::vector<float> break_edges(std::span<const Stroke> strokes, const Room& room,
                               const Brush& brush) {
  std::vector<float> breaking(room.depth.size());
  for (const Stroke& stroke : strokes) {
    if (!seen_at(stroke, room, brush)) continue;
    const float turn = 2 * chance(stroke, 2) - 1, gain = std::copysign(0.4f + 0.6f * std::abs(turn), turn);
    cover(Dab(stroke, brush), room, [&](std::size_t pixel, float c) {
      if (c * std::abs(gain) > std::abs(breaking[pixel])) breaking[pixel] = c * gain;
    });
  }
  return breaking;
}

std::vector<float> paint_leaves(std::span<const Stroke> strokes, const Room& room,
                                const Brush& brush, float detail) {
  std::vector<float> covered(room.depth.size());
  for (const Stroke& stroke : strokes) {
    if (chance(stroke, 0) >= detail) continue;
    const std::optional<std::size_t> at = seen_at(stroke, room, brush);
    if (!at) continue;
    const float edge = 1 - smooth(0.5f, 0.98f, room.outline[*at]);
    const float light = smooth(0.3f, 0.7f, 1 - room.dark[*at]);
    const float wanted = detail * std::max(edge, 0.35f * light);
    const float fading = smooth(0, 0.1f, wanted - chance(stroke, 0));
    const float opacity = fading * (0.6f + 0.4f * chance(stroke, 1));
    if (opacity <= 0) continue;
    cover(Dab(stroke, brush), room, [&](std::size_t pixel, float c) {
      covered[pixel] = std::max(covered[pixel], opacity * c);
    });
  }
  return covered;
}

}  // namespace leafhull::watercolour
