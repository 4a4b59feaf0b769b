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
  double area = 0;                              ///< of its leaves that is visible, one side of it

  /// How thick a plate of this surface and volume is.
  double thickness() const { return 2 * volume / surface; }
};

using EigenTriangle = std::array<Eigen::Vector3d, 3>;

/// The closed surface of a component, or none where it does not enclose anything. Two faces that
/// lie on each other, as between the cubes of a crown of cubes, cancel; where all do, as in a crown
/// with back faces, one of each stays. Openings, as at the foot of a dome, are closed by a cone
/// over their rim, unless these cones are larger than 0.55 of the surface. Its triangles face the
/// same way, inwards or outwards.
std::vector<EigenTriangle> closed_surface(const LeafMesh& component);

}  // namespace leafhull
