// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "leafhull/vec.h"

namespace leafhull::watercolour {

/// The kind of stroke that paints a single leaf.
enum class Mark {
  dab,   ///< two arcs that meet at its tips
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
  std::span<const Stroke> strokes{};  ///< in any order that stays the same; may be none
  /// The leaves' colours, linear, the most frequent first. If there are several, the buffers'
  /// colour says which one applies where; none: the green that styles are made for.
  std::span<const Vec3f> tones{};
  Mark mark = Mark::dab;
};

/// The picture in which strokes are painted.
struct Room {
  int width = 0, height = 0;
  std::span<const float> outline;  ///< 0 outside the foliage to 1 inside, soft
  std::span<const float> dark;     ///< 1 - the light
  std::span<const float> depth;    ///< of the nearest surface, infinite on paper
};

struct Brush {
  float size = 1;       ///< the size of a stroke, in leaves
  float least = 0;      ///< the least half-length, pixels
  float most = 0;       ///< the largest half-length; a larger card is a spray of leaves
  float tolerance = 0;  ///< how far behind the surface a leaf is still painted
  Mark mark = Mark::dab;
};

/// How leaves break the edges of washes: for each pixel, what its strongest leaf adds or removes,
/// -1..1. A hash of the leaf decides between the two.
std::vector<float> break_edges(std::span<const Stroke> strokes, const Room& room,
                               const Brush& brush);

/// How much of each pixel is covered by leaves painted one by one, 0..1. At the silhouette and in
/// the light, the share `detail` of the leaves is painted. A hash of the leaf alone selects them,
/// so that leaves stay or fade as the tree turns.
std::vector<float> paint_leaves(std::span<const Stroke> strokes, const Room& room,
                                const Brush& brush, float detail);

}  // namespace leafhull::watercolour
