// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "density/lattice.h"
#include "leafhull/shape.h"

namespace leafhull {

/// A kernel in lattice units: xi(p) is the squared length of (axes . (p - cell - offset)), so an
/// axis is a unit vector over its radius in voxels. Source: Eq. (3).
struct LatticeKernel {
  Coord cell;                 ///< holds the centre
  Vec3f offset;               ///< of the centre in its cell, [0, 1)
  std::array<Vec3f, 3> axes;  ///< major, minor, normal
};

inline LatticeKernel to_lattice(const Kernel& kernel, const Lattice& lattice) {
  const Vec3d centre = lattice.local(kernel.centre);
  const Coord cell = cell_of(centre);
  const Vec3d major(kernel.major), normal(kernel.normal);
  const auto axis = [&](Vec3d direction, float radius) {
    return Vec3f(direction * (lattice.voxel_size / static_cast<double>(radius)));
  };
  return {cell,
          Vec3f(centre - to_vec3d(cell)),
          {axis(major, kernel.radius_major), axis(cross(normal, major), kernel.radius_minor),
           axis(normal, kernel.radius_normal)}};
}

}  // namespace leafhull
