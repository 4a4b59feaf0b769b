// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "density.h"
#include "ply.h"

namespace recount {

struct MeshFacts {
  std::size_t unmatched_edges = 0;  ///< directed edges not used once with their reverse once
  std::size_t unused_vertices = 0;
  std::size_t components = 0;  ///< connected by triangles that share vertices
  /// Whose triangles face up the density, not down, and whose volume is negative. (A hollow has a
  /// negative volume and faces down.)
  std::size_t inward_components = 0;
  double volume = 0;                  ///< signed; model units cubed
  std::vector<double> distances;      ///< |N - T| / |grad N| of each vertex, model units
  std::vector<double> normal_angles;  ///< of each stored normal to -grad N, degrees
};

/// `densities` are N and its gradient at the mesh's vertices; those farther than `near` from
/// N = T have no say in which way a component faces, for there the gradient is no normal, and
/// neither have components of a volume below `smallest`, whose few vertices are folds.
MeshFacts examine(const Ply& mesh, const std::vector<Density>& densities, double threshold,
                  double near, double smallest);

/// The least value that the fraction `f` of the values does not exceed.
double percentile(std::vector<double> values, double f);

}  // namespace recount
