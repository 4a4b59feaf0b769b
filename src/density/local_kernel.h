// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "density/lattice.h"
#include "leafhull/shape.h"

namespace leafhull {

/// A kernel in lattice units, as the device reads it (`Kernel` of density.clh): xi(p) = |U d|^2 for
/// d = p - cell - offset and U upper triangular. U has the same U^T U as the axes over their radii
/// (Eq. 3), so xi is the same and takes fewer products.
struct LatticeKernel {
  Coord cell;                    ///< holds the centre
  Vec3f offset;                  ///< of the centre in its cell, [0, 1)
  float xx, xy, xz, yy, yz, zz;  ///< U, row by row, 1 / voxels; xx, yy, zz > 0
};
static_assert(sizeof(LatticeKernel) == 48);

// N is summed in floats, here and on the device. Bounds on xi give way by more than the rounding of
// a position (a share of the box, as thin kernels magnify it, and of how far kernels are) and of
// xi.
inline constexpr float kPositionSlack = 1e-5f;
inline constexpr float kDistanceSlack = 4e-7f;
inline constexpr float kXiSlack = 1e-4f;

/// U comes from the axes by Gram-Schmidt on their columns, the R of a QR decomposition: unlike a
/// Cholesky factor of U^T U it keeps its digits where a kernel is thin.
inline LatticeKernel to_lattice(const Kernel& kernel, const Lattice& lattice) {
  const Vec3d centre = lattice.local(kernel.centre);
  const Coord cell = cell_of(centre);
  LatticeKernel local{cell, Vec3f(centre - to_vec3d(cell)), 0, 0, 0, 0, 0, 0};
  if (kernel.radius_major == kernel.radius_minor && kernel.radius_major == kernel.radius_normal) {
    local.xx = local.yy = local.zz =
        static_cast<float>(lattice.voxel_size / static_cast<double>(kernel.radius_major));
    return local;
  }
  const Vec3d major(kernel.major), normal(kernel.normal);
  const auto over = [&](Vec3d direction, float radius) {
    return direction * (lattice.voxel_size / static_cast<double>(radius));
  };
  const Vec3d u = over(major, kernel.radius_major);
  const Vec3d v = over(cross(normal, major), kernel.radius_minor);
  const Vec3d n = over(normal, kernel.radius_normal);
  const Vec3d x(u.x, v.x, n.x);
  Vec3d y(u.y, v.y, n.y), z(u.z, v.z, n.z);

  const double xx = length(x), xy = dot(x, y) / xx, xz = dot(x, z) / xx;
  y = y - x * (xy / xx);
  z = z - x * (xz / xx);
  const double yy = length(y), yz = dot(y, z) / yy;
  z = z - y * (yz / yy);
  local.xx = static_cast<float>(xx), local.xy = static_cast<float>(xy);
  local.xz = static_cast<float>(xz), local.yy = static_cast<float>(yy);
  local.yz = static_cast<float>(yz), local.zz = static_cast<float>(length(z));
  return local;
}

}  // namespace leafhull
