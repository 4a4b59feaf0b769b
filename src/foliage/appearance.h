// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "leafhull/tree.h"

namespace leafhull {

/// The forms of a part's pieces, as the shares of its area in pieces of each form.
struct Forms {
  double flat = 0;  ///< leaves, cards
  double tube = 0;  ///< trunks, branches, skeletons of them
  double lobe = 0;  ///< closed or open shells about as thick as long
  double slab = 0;  ///< wide and level, at the foot of everything
};

/// A part of a primitive that looks alike: all of it, or its triangles of one colour, with holes,
/// or of one form.
struct Appearance {
  std::uint32_t primitive = 0;
  double area = 0;  ///< of the first instance, one side, world units squared
  Vec3f colour{};   ///< linear, mean of what is visible
  bool has_colour = false;
  double cut = 0;  ///< share of its area that the texture's alpha cuts away
  Forms forms{};
  std::size_t pieces = 0;   ///< connected pieces
  double piece_length = 0;  ///< longest side of pieces' boxes, mean by area, over the tree's size
  Vec3d centre{};           ///< mean by area, world
};

/// The appearances in a primitive and, if there are several, the one that each triangle has.
struct Appearances {
  std::vector<Appearance> parts;
  std::vector<std::uint8_t> part_of;  ///< by triangle; empty: all of the first
  std::vector<std::uint32_t> welded;  ///< by vertex, as weld_positions() returns it
};

/// Whether a primitive may be cut into parts.
enum class Cutting { none, where_it_differs };

/// @param to_world the primitive's first place; @param all the box of everything in the file.
Appearances look_at(const TreeModel& tree, std::uint32_t primitive, const Transform& to_world,
                    const Box& all, Cutting cutting);

}  // namespace leafhull
