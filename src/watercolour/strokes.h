// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "leafhull/vec.h"

namespace leafhull::watercolour {

/// What a single leaf is painted with.
enum class Mark {
  dab,   ///< two arcs that meet in its tips
  tuft,  ///< needles from one point
  blade  ///< a long frond
};

/// A leaf as the camera sees it; pixels from the picture's top left corner.
struct Stroke {
  Vec2f centre, half_major, half_minor;
  float depth = 0;  ///< as render::Buffers::depth
  std::uint32_t leaf = 0;
};

/// A tree's leaves, for a picture.
struct Leaves {
  std::span<const Stroke> strokes{};  ///< in any order that is the same each time; may be none
  /// The colours that they have, linear, that of most first. Where there are several, the buffers'
  /// colour says where which is; none: the green that styles are made for.
  std::span<const Vec3f> tones{};
  Mark mark = Mark::dab;
};

/// Where strokes may go.
struct Room {
  int width = 0, height = 0;
  std::span<const float> outline;  ///< 0 outside the foliage to 1 inside, soft
  std::span<const float> dark;     ///< 1 - the light
  std::span<const float> depth;    ///< of the nearest surface, infinite on paper
};

struct Brush {
  float size = 1;       ///< of a stroke, in leaves
  float least = 0;      ///< of the half-length, pixels
  float most = 0;       ///< of the half-length; a larger card is a spray of leaves
  float tolerance = 0;  ///< how far behind the surface a leaf is still painted
  Mark mark = Mark::dab;
};

/// Leaves that break the edges of washes: each pixel has what its strongest leaf adds or takes,
/// -1..1. Which of the two is a hash of the leaf.
std::vector<float> break_edges(std::span<const Stroke> strokes, const Room& room,
                               const Brush& brush);

/// How much of each pixel leaves cover that are painted one by one, 0..1: at the silhouette and in
/// the light, the part `detail` of them. Which, is a hash of the leaf alone, so that a leaf that
/// turns with the tree stays or fades.
std::vector<float> paint_leaves(std::span<const Stroke> strokes, const Room& room,
                                const Brush& brush, float detail);

}  // namespace leafhull::watercolour
