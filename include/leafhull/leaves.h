// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "leafhull/tree.h"
#include "leafhull/vec.h"

namespace leafhull {

/// A leaf's ellipse drawn in texture space (0..1, v down): its centre and two half-axis vectors.
struct TextureEllipse {
  Vec2d centre, a, b;
};

struct LeafOptions {
  std::vector<std::string> globs;         ///< empty: alpha mode and usual names decide
  std::optional<TextureEllipse> ellipse;  ///< empty: the alpha texture, else the triangles
  double scale = 1;                       ///< multiplies R_u and R_v; > 0
};

/// Where a kernel sits: a vertex of a leaf with the leaf's frame. The third axis is normal x major.
struct LeafVertex {
  Vec3d position;      ///< c_j, model units
  Vec3f normal;        ///< n_j, unit
  Vec3f major;         ///< u_j, unit, orthogonal to the normal
  float radius_major;  ///< R_u, model units
  float radius_minor;  ///< R_v <= R_u
  std::uint32_t leaf;  ///< which leaf, below LeafSet::leaf_count
};

/// A place for a kernel: the middle of a part of a leaf or of leaves that lie together, or a
/// vertex. The third axis is normal x major. SPEC: 1b.
struct LeafPoint {
  Vec3d position;      ///< c_j, model units
  Vec3f normal;        ///< n_j, unit
  Vec3f major;         ///< u_j, unit, orthogonal to the normal
  float radius_major;  ///< R_u, model units
  float radius_minor;  ///< R_v <= R_u
  double area;         ///< a_j, model units squared; 0: a vertex, whose kernel has the weight 1
};

/// The leaves as visible area; only leafhull's own stages look inside.
struct LeafSheets;

struct LeafSet {
  std::vector<LeafVertex> vertices;  ///< in an order that depends on the geometry alone
  std::size_t leaf_count = 0;
  /// Of each leaf, its place among them in the file, by which a leaf of a moving tree is known from
  /// frame to frame; or none.
  std::vector<std::uint32_t> order_in_file;
  std::size_t dropped_leaves = 0;    ///< zero area, no usable normal or not finite
  std::size_t split_components = 0;  ///< components that were not one flat leaf
  double mean_radius_major = 0;      ///< mean R_u over the leaves, model units
  double area = 0;                   ///< that is visible, one side of it, model units squared
  std::shared_ptr<const LeafSheets> sheets;  ///< what `area` is of
  Box bounds;                                ///< of the vertices
  /// Of the vertices but for strays, the few leaves that lie far from the rest: what lengths in
  /// crown units and resolutions count along. SPEC: 4.
  Box crown;
  std::size_t stray_leaves = 0;
  std::vector<std::string> warnings;
};

/// How one primitive of a file looks to the choice of leaves.
struct PrimitiveSummary {
  std::string material, mesh, node;
  AlphaMode alpha_mode = AlphaMode::opaque;
  std::size_t instances = 0, vertices = 0, triangles = 0;
  bool leaves = false;  ///< would be taken as leaves
};

/// One row per primitive and distinct node name, in file order. SPEC: 1, "which primitives are
/// leaves".
std::vector<PrimitiveSummary> summarize(const TreeModel& tree, const LeafOptions& options);

/// Whether an instance would be taken as leaves. SPEC: 1.
bool is_leaf(const TreeModel& tree, const Instance& instance, const LeafOptions& options);

/// The leaves of a tree, one kernel frame at every leaf vertex. SPEC: 1; Source: Eqs. (5), (6),
/// p. 51.
/// @throws Error input where nothing matches (the names in the file are listed) or nothing is
/// usable;
///         usage where an option is out of range.
LeafSet find_leaves(const TreeModel& tree, const LeafOptions& options);

/// The same of some instances of the tree's primitives, which need not be its own.
LeafSet find_leaves(const TreeModel& tree, std::span<const Instance> instances,
                    const LeafOptions& options);

}  // namespace leafhull
