// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "leafhull/leaves.h"

namespace leafhull {

/// Where the kernels sit, and where the density is evaluated.
struct LeafPoints {
  std::vector<LeafPoint> points;  ///< in an order that depends on the geometry alone
  /// Places that each stand for an equal share of the leaves: their vertices, or even samples of
  /// their visible area without strays. A coverage is a share of these.
  std::vector<Vec3d> samples;
  std::vector<bool> in_solid;  ///< for each sample, whether it lies on a filled solid; or none
  double area = 0;             ///< of all points, model units squared; 0 if they are vertices
};

/// The least R_max in spacings. With a smaller R_max, kernels around parts no longer add up to an
/// even sheet, and parts show.
inline constexpr double kLeastRadius = 2.5;

/// A point without area at every leaf vertex, as in the paper.
LeafPoints vertex_points(const LeafSet& leaves);

/// Parts of visible leaf area of about spacing^2 each, SPEC: 1b. A leaf is cut into
/// ceil(area / spacing^2) parts, more where it is long; what is much smaller is joined within the
/// cells of a lattice of edge `spacing`, and so is everything in cells that hold several layers:
/// so the number of points is bounded by the area over spacing^2 and by the volume of the crown. A
/// leaf that is one part keeps its ellipse; other parts have their own second moments and no radius
/// in their plane below kLeastRadius * spacing. A closed surface is no sheet: it is filled with
/// points, over which its area is spread evenly, unless it is thinner than kernels reach.
/// @param spacing model units, > 0.
/// @param radius_max R_max, model units, by which closed surfaces are filled; > 0.
/// @throws Error usage where it would make more than ten million parts; input where no leaf is
/// visible.
LeafPoints area_points(const LeafSet& leaves, double spacing, double radius_max);

}  // namespace leafhull
