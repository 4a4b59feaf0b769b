// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "foliage/surface_colour.h"
#include "leafhull/tree.h"

namespace leafhull {

enum class Form { flat, tube, lobe, slab };

/// Connected triangles.
struct Piece {
  double area = 0;
  double kept = 0;    ///< the share of the area that is not cut away
  double spread = 0;  ///< as Shown::spread, mean over the area
  Vec3d colour;       ///< linear, mean over what is kept
  Vec3d middle;       ///< of its box, in the world
  double length = 0;  ///< the longest side of its box
  std::size_t triangles = 0;
  Form form = Form::lobe;
};

/// A primitive in the world: how large its triangles are, what they show and what they form.
struct Surface {
  std::vector<double> areas;            ///< by triangle
  std::vector<std::uint32_t> piece_of;  ///< by triangle
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> welded;  ///< by vertex, as weld_positions() returns it
  std::vector<Shown> shown;           ///< by triangle, or one for all of them

  const Shown& shown_at(std::size_t triangle) const {
    return shown.size() == 1 ? shown.front() : shown[triangle];
  }
};

/// The size of a tree: the height of everything in the file, unless that lies flat.
/// `all`: the box of everything.
double scale_of(const Box& all);

/// Looks at a primitive of `tree` where `to_world` puts it.
Surface survey(const TreeModel& tree, const Primitive& primitive, const Transform& to_world,
               const Box& all);

}  // namespace leafhull
