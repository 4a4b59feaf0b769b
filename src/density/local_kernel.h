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

inline bool is_isotropic(const Kernel& kernel) {
  return kernel.radius_major == kernel.radius_minor && kernel.radius_major == kernel.radius_normal;
}

/// A kernel's axes over their radii, model units: xi(p) = (u.d)^2 + (v.d)^2 + (n.d)^2.
struct KernelForm {
  Vec3d u, v, n;
};

inline KernelForm form_of(const Kernel& kernel) {
  const Vec3d major(kernel.major), normal(kernel.normal);
  const auto over = [](Vec3d direction, float radius) {
    return direction * (1 / static_cast<double>(radius));
  };
  return {over(major, kernel.radius_major), over(cross(normal, major), kernel.radius_minor),
          over(normal, kernel.radius_normal)};
}

/// A kernel around `centre`, model units, without its form.
inline LatticeKernel to_lattice(Vec3d centre, const Lattice& lattice) {
  const Vec3d local = lattice.local(centre);
  const Coord cell = cell_of(local);
  return {cell, Vec3f(local - to_vec3d(cell)), 0, 0, 0, 0, 0, 0};
}

/// A sphere.
inline LatticeKernel to_lattice(Vec3d centre, double radius, const Lattice& lattice) {
  LatticeKernel local = to_lattice(centre, lattice);
  local.xx = local.yy = local.zz = static_cast<float>(lattice.voxel_size / radius);
  return local;
}

/// U comes from the axes by Gram-Schmidt on their columns, the R of a QR decomposition: unlike a
/// Cholesky factor of U^T U it keeps its digits where a kernel is thin.
inline LatticeKernel to_lattice(Vec3d centre, const KernelForm& form, const Lattice& lattice) {
  LatticeKernel local = to_lattice(centre, lattice);
  const Vec3d u = form.u * lattice.voxel_size, v = form.v * lattice.voxel_size,
              n = form.n * lattice.voxel_size;
  const Vec3d x(u.x, v.x, n.x);
  Vec3d y(u.y, v.y, n.y), z(u.z, v.z, n.z);

  const double xx = length(x), over_xx = 1 / xx, xy = dot(x, y) * over_xx, xz = dot(x, z) * over_xx;
  y = y - x * (xy * over_xx);
  z = z - x * (xz * over_xx);
  const double yy = length(y), over_yy = 1 / yy, yz = dot(y, z) * over_yy;
  z = z - y * (yz * over_yy);
  local.xx = static_cast<float>(xx), local.xy = static_cast<float>(xy);
  local.xz = static_cast<float>(xz), local.yy = static_cast<float>(yy);
  local.yz = static_cast<float>(yz), local.zz = static_cast<float>(length(z));
  return local;
}

inline LatticeKernel to_lattice(const Kernel& kernel, const Lattice& lattice) {
  return is_isotropic(kernel)
             ? to_lattice(kernel.centre, static_cast<double>(kernel.radius_major), lattice)
             : to_lattice(kernel.centre, form_of(kernel), lattice);
}

}  // namespace leafhull
