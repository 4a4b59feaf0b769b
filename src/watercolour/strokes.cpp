// SPDX-License-Identifier: Apache-2.0
#include "watercolour/strokes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "render/sampling.h"

namespace leafhull::watercolour {
namespace {

constexpr int kMostOfSpray = 16;

float smooth(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

float unit(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

/// Random number `which` of a leaf, 0..1.
float chance(std::uint32_t leaf, std::uint32_t which) {
  return unit(render::hash(3 * leaf + which));
}

/// A leaf's outline: two arcs that meet at its tips.
struct Dab {
  Vec2f centre, along;  ///< along: unit
  float length, width;  ///< half of each
  float depth;
  std::uint32_t leaf;

  /// Roughly how much of the pixel around (x, y) it covers.
  float coverage(float x, float y) const {
    const float dx = x - centre.x, dy = y - centre.y;
    const float u = (dx * along.x + dy * along.y) / length;
    const float v = std::abs(dy * along.x - dx * along.y);
    return std::clamp((1 - u * u) * width - v + 0.5f, 0.0f, 1.0f);
  }
};

float norm(Vec2f v) { return std::hypot(v.x, v.y); }

/// The shape of a mark: the width of its dabs over their length (leaves seen edge-on are not
/// hairs), their length over the brush's, their number, the angle between them, and the angle by
/// which leaves of a spray turn from its card; radians.
struct Shape {
  float least_width, most_width, length;
  int count;
  float fan, turn;
};

Shape shape_of(Mark mark) {
  switch (mark) {
    case Mark::tuft:
      return {.least_width = 0.13f,
              .most_width = 0.13f,
              .length = 1.3f,
              .count = 3,
              .fan = 0.42f,
              .turn = 0.35f};
    case Mark::blade:
      return {.least_width = 0.2f,
              .most_width = 0.2f,
              .length = 2.2f,
              .count = 1,
              .fan = 0,
              .turn = 0.3f};
    case Mark::dab:
      break;
  }
  return {.least_width = 0.38f, .most_width = 1, .length = 1, .count = 1, .fan = 0, .turn = 1};
}

Vec2f turned(Vec2f v, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// Fans a mark out from its lower end.
template <class Take>
void each_of_mark(const Dab& middle, const Shape& shape, Take&& take) {
  const Vec2f foot{middle.centre.x - middle.length * middle.along.x,
                   middle.centre.y - middle.length * middle.along.y};
  for (int i = 0; i < shape.count; ++i) {
    Dab dab = middle;
    dab.along = turned(middle.along, shape.fan * (static_cast<float>(i) -
                                                  0.5f * static_cast<float>(shape.count - 1)));
    dab.centre = {foot.x + dab.length * dab.along.x, foot.y + dab.length * dab.along.y};
    take(dab);
  }
}

/// Visits the dabs of a stroke: those of one mark or, for a card larger than the brush, those of a
/// spray over the card.
template <class Take>
void each_dab(const Stroke& stroke, const Brush& brush, Take&& take) {
  Vec2f major = stroke.half_major, minor = stroke.half_minor;
  if (norm(minor) > norm(major) && brush.mark == Mark::dab) std::swap(major, minor);
  const float length = norm(major), width = norm(minor);
  const bool has_length = length > 0 && length < HUGE_VALF && width < HUGE_VALF;
  if (!has_length) return;
  const Shape shape = shape_of(brush.mark);
  const Vec2f along{major.x / length, major.y / length};
  const float longest = std::max(length, width);
  const float half = std::clamp(brush.size * longest, brush.least, brush.most);
  const float cards = brush.size * longest / half;
  Dab dab{stroke.centre, along, shape.length * half, 0, stroke.depth, stroke.leaf};
  dab.width = shape.least_width * dab.length;
  if (cards <= 1) {
    dab.width = std::clamp(brush.size * width, dab.width, shape.most_width * dab.length);
    each_of_mark(dab, shape, take);
    return;
  }
  const int count = static_cast<int>(std::min<float>(kMostOfSpray, std::ceil(cards * cards)));
  for (int i = 0; i < count; ++i) {
    const std::uint32_t leaf = render::hash(stroke.leaf * kMostOfSpray + i);
    const float r = std::sqrt(unit(render::hash(leaf + 1)));
    const float angle = 2 * std::numbers::pi_v<float> * unit(render::hash(leaf + 2));
    const float s = r * std::cos(angle), t = r * std::sin(angle);
    dab.leaf = leaf;
    dab.centre = {stroke.centre.x + s * major.x + t * minor.x,
                  stroke.centre.y + s * major.y + t * minor.y};
    dab.along = turned(along, shape.turn * (2 * unit(render::hash(leaf + 3)) - 1));
    each_of_mark(dab, shape, take);
  }
}

/// The pixel of a dab's centre, and how much of the dab shows through surfaces in front of it.
struct Place {
  std::size_t pixel;
  float visible;
};

/// The place of a dab; none if it lies outside the picture or is hidden.
std::optional<Place> place(const Dab& dab, const Room& room, const Brush& brush) {
  const Vec2f c = dab.centre;
  const auto width = static_cast<float>(room.width), height = static_cast<float>(room.height);
  const bool inside = c.x >= 0 && c.y >= 0 && c.x < width && c.y < height;
  if (!inside) return std::nullopt;
  const std::size_t at = static_cast<std::size_t>(c.y) * room.width + static_cast<std::size_t>(c.x);
  const float behind = dab.depth - room.depth[at];
  const float visible = 1 - smooth(0.5f * brush.tolerance, brush.tolerance, behind);
  return visible > 0 ? std::optional(Place{at, visible}) : std::nullopt;
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
    each_dab(stroke, brush, [&](const Dab& dab) {
      const std::optional<Place> at = place(dab, room, brush);
      if (!at) return;
      const float turn = 2 * chance(dab.leaf, 2) - 1;
      const float gain = std::copysign(at->visible * (0.4f + 0.6f * std::abs(turn)), turn);
      cover(dab, room, [&](std::size_t pixel, float c) {
        if (c * std::abs(gain) > std::abs(breaking[pixel])) breaking[pixel] = c * gain;
      });
    });
  }
  return breaking;
}

std::vector<float> paint_leaves(std::span<const Stroke> strokes, const Room& room,
                                const Brush& brush, float detail) {
  std::vector<float> covered(room.depth.size());
  for (const Stroke& stroke : strokes) {
    each_dab(stroke, brush, [&](const Dab& dab) {
      const float rank = chance(dab.leaf, 0);
      if (rank >= detail) return;
      const std::optional<Place> at = place(dab, room, brush);
      if (!at) return;
      const float near = smooth(0, 0.1f, room.outline[at->pixel]);
      const float edge = 1 - smooth(0.5f, 0.98f, room.outline[at->pixel]);
      const float light = smooth(0.3f, 0.7f, 1 - room.dark[at->pixel]);
      const float wanted = detail * near * std::max(edge, 0.35f * light);
      const float opacity =
          at->visible * smooth(0, 0.1f, wanted - rank) * (0.6f + 0.4f * chance(dab.leaf, 1));
      if (opacity <= 0) return;
      cover(dab, room, [&](std::size_t pixel, float c) {
        covered[pixel] = std::max(covered[pixel], opacity * c);
      });
    });
  }
  return covered;
}

}  // namespace leafhull::watercolour
