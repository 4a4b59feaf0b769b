// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "leafhull/tree.h"

namespace leafhull {

struct LeafMesh;

/// A triangle whose corners are known twice: by position, where exporters' seams are welded, and by
/// stored vertex, which has the texture coordinates and the normal.
struct Face {
  std::array<std::uint32_t, 3> position;  ///< into WeldedMesh::positions; the least rotation
  std::array<std::uint32_t, 3> vertex;    ///< into Primitive::positions
  auto operator<=>(const Face&) const = default;
};

/// Things in groups, each group side by side.
template <class Thing>
class Grouped {
 public:
  /// Things with equal labels form a group and keep their order; groups go by label.
  Grouped(std::span<const Thing> things, std::span<const std::uint32_t> labels)
      : things_(things.size()) {
    std::vector<std::size_t> next(labels.empty() ? 1 : std::ranges::max(labels) + std::size_t{2});
    for (const std::uint32_t label : labels) ++next[label + 1];
    for (std::size_t label = 1; label < next.size(); ++label) {
      if (next[label] > 0) ends_.push_back(next[label - 1] + next[label]);
      next[label] += next[label - 1];
    }
    for (std::size_t i = 0; i < things.size(); ++i) things_[next[labels[i]]++] = things[i];
  }

  std::size_t size() const { return ends_.size(); }
  std::span<const Thing> operator[](std::size_t group) const {
    const std::size_t begin = group == 0 ? 0 : ends_[group - 1];
    return std::span(things_).subspan(begin, ends_[group] - begin);
  }

 private:
  std::vector<Thing> things_;
  std::vector<std::size_t> ends_;
};
using FaceGroups = Grouped<Face>;

/// A primitive whose vertices at bit-equal positions are one. Everything is in an order that
/// depends on the geometry alone, so that sums over it do too.
struct WeldedMesh {
  std::vector<Vec3f> positions;  ///< distinct, ascending by x, y, z; no negative zero
  std::vector<Face> faces;       ///< ascending by position
};

/// Which of the primitive's distinct positions each vertex has, as WeldedMesh counts them.
std::vector<std::uint32_t> weld_positions(const Primitive& primitive);

/// What weld_positions() returns for each primitive of a tree; a primitive may have none.
struct WeldedPrimitives {
  std::vector<std::vector<std::uint32_t>> of;
};

/// Tells whether `welded` still holds for the primitive, whose vertices may have moved since.
bool is_welded(const Primitive& primitive, std::span<const std::uint32_t> welded);

/// Welds the marked triangles of the primitive, or all of them if `triangles` is empty. `welded` is
/// what weld_positions() returns.
WeldedMesh weld(const Primitive& primitive, std::span<const std::uint32_t> welded,
                const std::vector<bool>& triangles = {});

/// The piece that each triangle of a primitive belongs to. A piece is a set of triangles connected
/// by vertices; pieces are numbered in file order. `welded` is as above.
std::vector<std::uint32_t> label_pieces(const Primitive& primitive,
                                        std::span<const std::uint32_t> welded);

/// Groups of triangles that are connected by vertices.
FaceGroups connected_components(const WeldedMesh& mesh);

/// Groups of faces that are connected across edges no sharper than 45 degrees.
FaceGroups split_at_sharp_edges(const LeafMesh& leaf);

/// Groups of a single triangle; its front and back stay together.
FaceGroups split_into_triangles(std::span<const Face> faces);

}  // namespace leafhull
