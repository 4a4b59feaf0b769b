// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "leafhull/api.h"
#include "leafhull/tree.h"
#include "leafhull/vec.h"

namespace leafhull {

/// A leaf's ellipse drawn in texture space (0..1, v down): its centre and two half-axis vectors.
struct TextureEllipse {
  Vec2d centre, a, b;
};

/// Red, green and blue, 8 bits each of sRGB.
using Srgb = std::array<std::uint8_t, 3>;

/// The colour of the leaves, for files whose names do not tell which triangles are leaves.
struct LeafColour {
  Srgb srgb{};
  /// The largest distance in Oklab that still counts as this colour; 0: distances are parted into
  /// two classes, and the nearer one counts.
  double tolerance = 0;
};

struct LeafOptions {
  std::vector<std::string> globs;         ///< empty: evidence decides
  std::vector<std::string> not_globs;     ///< what is never leaves, whatever else it matches
  std::optional<LeafColour> colour;       ///< keeps only the triangles of this colour
  std::optional<Srgb> tint;               ///< the colour to draw them in; empty: their own
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

struct LeafChoice;

struct LeafSet {
  struct Sheets;                     ///< the leaves as visible area, for leafhull's own stages
  std::vector<LeafVertex> vertices;  ///< in an order that depends on the geometry alone
  std::size_t leaf_count = 0;
  /// Each leaf's index in the file, stable across the frames of a moving tree; or none.
  std::vector<std::uint32_t> order_in_file;
  std::size_t dropped_leaves = 0;        ///< zero area, no usable normal or not finite
  std::size_t split_components = 0;      ///< components that were not one flat leaf
  double mean_radius_major = 0;          ///< mean R_u over the leaves, model units
  double area = 0;                       ///< visible area of one side only, in model units squared
  std::optional<Vec3f> colour;           ///< linear, mean; none: unknown
  std::shared_ptr<const Sheets> sheets;  ///< the surfaces that `area` measures
  Box bounds;                            ///< of the vertices
  /// The box of the vertices without strays, the few leaves that lie far from the rest. Lengths in
  /// crown units and resolutions refer to it. SPEC: 4.
  Box crown;
  std::size_t stray_leaves = 0;
  std::shared_ptr<const LeafChoice> choice;  ///< how they were found
  std::vector<std::string> warnings;
};

/// How much speaks for something being leaves (above 0) or against it, roughly as log odds.
struct LeafEvidence {
  double name = 0;    ///< words in the names of material, texture, mesh, node and its parents
  double alpha = 0;   ///< holes in the texture where the triangles use it
  double colour = 0;  ///< green, autumn and blossom against brown and grey
  double shape = 0;   ///< small flat pieces and lobes against tubes and the ground
  double place = 0;   ///< high up against low down
  double total() const { return name + alpha + colour + shape + place; }
};

/// What a single leaf looks like, for brush strokes.
enum class LeafKind { broad, needle, frond };

/// Why something is or is not taken as leaves.
enum class LeafVerdict { leaves, other, undergrowth, minor, not_asked_for };

/// Something in a file that could be leaves: a primitive with its names, or a part of it that looks
/// alike.
struct LeafCandidate {
  std::string material, mesh, node;  ///< or none
  AlphaMode alpha_mode = AlphaMode::opaque;
  std::string colour;    ///< "#rrggbb" in sRGB, mean of what is visible; or none
  bool is_part = false;  ///< it is part of a primitive that holds other things too
  std::size_t instances = 0, vertices = 0, triangles = 0;
  double area = 0;   ///< of all instances, one side, model units squared
  std::string word;  ///< the word in the names that counted most
  LeafEvidence evidence;
  LeafVerdict verdict = LeafVerdict::other;
};

/// Which triangles of a tree are its leaves, and why.
struct LeafChoice {
  struct Welded;  ///< vertices of the tree that lie in one place, for find_leaves()

  std::vector<bool> instances;               ///< whether any of its triangles are leaves
  std::vector<std::vector<bool>> triangles;  ///< by primitive, those that are leaves; empty: all
  std::vector<bool> cut_out;   ///< by material: the alpha of its image counts though it is opaque
  std::vector<bool> left_out;  ///< by instance: a coarser level of detail of another one
  std::shared_ptr<const Welded> welded;   ///< for find_leaves() to reuse; or none
  std::vector<LeafCandidate> candidates;  ///< the likeliest first
  /// The leaves' mean linear colour by visible area: texture times factor times vertex colour. None
  /// where the file gives no colour.
  std::optional<Vec3f> colour;
  bool is_tinted = false;            ///< `colour` was given as --leaf-colour
  LeafKind kind = LeafKind::broad;   ///< the kind of most leaves, as names say
  std::string told;                  ///< what was taken, what was skipped, and why; one line
  std::vector<std::string> options;  ///< those that would take the likeliest candidates
  std::vector<std::string> warnings;

  LEAFHULL_API bool any() const;
};

/// Weighs what names, alpha, colour, shape and place say, or does as the options ask. SPEC: 1.
/// @throws Error usage: an option is out of range.
LEAFHULL_API LeafChoice choose_leaves(const TreeModel& tree, std::span<const Instance> instances,
                                      const LeafOptions& options);
inline LeafChoice choose_leaves(const TreeModel& tree, const LeafOptions& options) {
  return choose_leaves(tree, tree.instances, options);
}

/// The leaves of a tree, one kernel frame at every leaf vertex. SPEC: 1; Source: Eqs. (5), (6),
/// p. 51.
/// @throws Error input where there are none (the file's names are listed) or nothing is usable;
///         usage where an option is out of range.
LEAFHULL_API LeafSet find_leaves(const TreeModel& tree, const LeafOptions& options);

/// Finds the leaves of an earlier choice.
LEAFHULL_API LeafSet find_leaves(const TreeModel& tree, const LeafChoice& choice,
                                 const LeafOptions& options);

/// Finds the chosen leaves among some instances of the tree's primitives, which need not be its
/// own.
LEAFHULL_API LeafSet find_leaves(const TreeModel& tree, std::span<const Instance> instances,
                                 const LeafChoice& choice, const LeafOptions& options);

}  // namespace leafhull
