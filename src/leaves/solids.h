// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "leafhull/vec.h"
#include "leaves/leaf_mesh.h"

namespace leafhull {

/// A closed surface that stands for the foliage inside, as the crowns of low-poly trees do.
struct LeafSolid {
  std::vector<std::array<Vec3d, 3>> triangles;  ///< closed: every edge has an even number of them
  double surface = 0;                           ///< their area, model units squared
  double volume = 0;                            ///< what they enclose, model units cubed, >= 0
  double area = 0;                              ///< visible area of its leaves, one side

  /// The thickness of a plate with this surface and volume.
  double thickness() const { return 2 * volume / surface; }
};

using EigenTriangle = std::array<Eigen::Vector3d, 3>;

/// The closed surface of a component, or none if it encloses nothing. Two faces that lie on each
/// other cancel, as between the cubes of a crown of cubes; if all do, as in a crown with back
/// faces, one of each stays. Openings, as at the foot of a dome, are closed by a cone over their
/// rim, unless all cones exceed 0.55 of the surface. The triangles all face inwards or outwards.
std::vector<EigenTriangle> closed_surface(const LeafMesh& component);

}  // namespace leafhull
