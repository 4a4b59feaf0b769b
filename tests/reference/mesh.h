// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "density.h"
#include "ply.h"

namespace recount {

struct MeshFacts {
  std::size_t unmatched_edges = 0;  ///< edges not used exactly once in each direction
  std::size_t unused_vertices = 0;
  std::size_t components = 0;  ///< connected by triangles that share vertices
  /// Components whose triangles face up the density, not down, and whose volume is negative. (A
  /// hollow has a negative volume and faces down.)
  std::size_t inward_components = 0;
  double volume = 0;                  ///< signed; model units cubed
  std::vector<double> distances;      ///< |N - T| / |grad N| of each vertex, model units
  std::vector<double> normal_angles;  ///< of each stored normal to -grad N, degrees
};

/// `densities` are N and its gradient at the mesh's vertices. Vertices farther than `near` from
/// N = T do not count for which way a component faces, because the gradient there is not a normal.
/// Components with a volume below `smallest` do not count either: their few vertices are folds.
MeshFacts examine(const Ply& mesh, const std::vector<Density>& densities, double threshold,
                  double near, double smallest);

/// The least value that the fraction `f` of the values does not exceed.
double percentile(std::vector<double> values, double f);

}  // namespace recount
