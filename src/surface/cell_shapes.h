// SPDX-License-Identifier: Apache-2.0
// How the surface passes through a lattice cell, for each choice of corners inside.
// Source: Nielson, "Dual Marching Cubes", 2004; Wenger, "Isosurfaces", 2013, section 3.3.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace leafhull::cell {

/// The bit of an axis (0 to 2 for x to z) in the number of a corner.
constexpr unsigned bit(unsigned axis) { return 4u >> axis % 3; }

/// Edge 4 * axis + k runs along `axis`; bits 0 and 1 of k tell whether it lies on the high side of
/// the next axis and of the one after it, in cyclic order.
struct Edge {
  unsigned axis, low;  ///< the corner at its low end
};

constexpr Edge edge(unsigned number) {
  const unsigned axis = number / 4;
  return {axis, (number & 1 ? bit(axis + 1) : 0) | (number & 2 ? bit(axis + 2) : 0)};
}

/// The edge between two corners.
constexpr unsigned edge_between(unsigned a, unsigned b) {
  const unsigned axis = (a ^ b) == 4 ? 0 : (a ^ b) == 2 ? 1 : 2;
  return 4 * axis + (a & bit(axis + 1) ? 1 : 0) + (a & bit(axis + 2) ? 2 : 0);
}

/// The corners around face 2 * axis + side.
constexpr std::array<unsigned, 4> corners_around(unsigned face) {
  const unsigned axis = face / 2, at = face % 2 ? bit(axis) : 0;
  const unsigned b = bit(axis + 1), c = bit(axis + 2);
  return {at, at | b, at | b | c, at | c};
}

constexpr unsigned kNoFace = 6;

/// The patches of surface in a cell, each with a dual vertex.
struct Shape {
  std::uint8_t vertices = 0;
  std::array<std::uint8_t, 12> vertex{};   ///< of each crossed edge
  std::array<std::uint16_t, 4> crossed{};  ///< by each vertex's patch: a bit per edge
};

/// The shape of a cell whose corners inside are the bits of `inside`. On a face with four crossings
/// the surface cuts off each of the two corners outside; on the face `parted`, each of those
/// inside.
constexpr Shape shape_of(unsigned inside, unsigned parted) {
  std::array<unsigned, 12> patch{};  // the lowest edge that an edge is connected to
  for (unsigned e = 0; e < 12; ++e) patch[e] = e;
  const auto connect = [&](unsigned a, unsigned b) {
    const auto [low, high] = std::minmax({patch[a], patch[b]});
    for (unsigned& p : patch) p = p == high ? low : p;
  };
  for (unsigned face = 0; face < 6; ++face) {
    const auto around = corners_around(face);
    const auto cut_off = [&](unsigned i) {
      return (inside >> around[i % 4] & 1) == (face == parted ? 1 : 0);
    };
    const auto edge_after = [&](unsigned i) {
      return edge_between(around[i % 4], around[(i + 1) % 4]);
    };
    for (unsigned i = 0; i < 4; ++i) {  // a line from where a run of corners begins to its end
      if (cut_off(i) || !cut_off(i + 1)) continue;
      unsigned last = i + 1;
      while (cut_off(last + 1)) ++last;
      connect(edge_after(i), edge_after(last));
    }
  }

  Shape shape;
  for (unsigned e = 0; e < 12; ++e) {
    const auto [axis, low] = edge(e);
    if ((inside >> low & 1) == (inside >> (low | bit(axis)) & 1)) continue;
    shape.vertex[e] = patch[e] == e ? shape.vertices++ : shape.vertex[patch[e]];
    std::uint16_t& crossed = shape.crossed[shape.vertex[e]];
    crossed = static_cast<std::uint16_t>(crossed | 1u << e);
  }
  return shape;
}

constexpr bool is_ambiguous(unsigned inside, unsigned face) {
  const auto [a, b, c, d] = corners_around(face);
  const auto in = [&](unsigned corner) { return inside >> corner & 1; };
  return in(a) == in(c) && in(b) == in(d) && in(a) != in(b);
}

/// The face that one patch of the cell meets along two lines, or kNoFace.
constexpr unsigned face_met_twice(unsigned inside) {
  const Shape shape = shape_of(inside, kNoFace);
  for (unsigned face = 0; face < 6; ++face) {
    const auto [a, b, c, d] = corners_around(face);
    if (is_ambiguous(inside, face) &&
        shape.vertex[edge_between(a, b)] == shape.vertex[edge_between(c, d)]) {
      return face;
    }
  }
  return kNoFace;
}

inline constexpr auto kFaceMetTwice = [] {
  std::array<std::uint8_t, 256> faces{};
  for (unsigned inside = 0; inside < 256; ++inside) {
    faces[inside] = static_cast<std::uint8_t>(face_met_twice(inside));
  }
  return faces;
}();

/// Add this to the corners inside to get the shape that parts them on kFaceMetTwice.
inline constexpr unsigned kParted = 256;

/// Two dual vertices on either side of a face with four crossings would have two mesh edges between
/// them where both of their patches meet the face twice. There both cells part the corners inside,
/// and with them both patches. Such a face is the only one of its cells with four crossings, so
/// that nothing else changes.
inline constexpr auto kShapes = [] {
  std::array<Shape, 2 * kParted> shapes{};
  for (unsigned inside = 0; inside < 256; ++inside) {
    shapes[inside] = shape_of(inside, kNoFace);
    shapes[inside + kParted] = shape_of(inside, kFaceMetTwice[inside]);
  }
  return shapes;
}();

static_assert([] {
  for (unsigned inside = 0; inside < 256; ++inside) {
    if (kFaceMetTwice[inside] == kNoFace) continue;
    for (unsigned face = 0; face < 6; ++face) {
      if (is_ambiguous(inside, face) != (face == kFaceMetTwice[inside])) return false;
    }
    if (kShapes[inside + kParted].vertices != kShapes[inside].vertices + 1) return false;
  }
  return true;
}());

}  // namespace leafhull::cell
