// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "density/falloff.h"
#include "density/lattice.h"
#include "leafhull/shape.h"

namespace leafhull {

/// A kernel in lattice units, as the device reads it (`Kernel` of density.clh): with
/// d = p - cell - offset and U upper triangular D(p) = (h - |U d|^2)^k where |U d|^2 <= h. That is
/// w (1 - xi)^k for h = w^(1/k) and |U d|^2 = h xi, so that a weight costs no product in a sum.
/// U^T U is h times that of the axes over their radii (Eq. 3), in fewer products.
struct LatticeKernel {
  Coord cell;                    ///< holds the centre
  Vec3f offset;                  ///< of the centre in its cell, [0, 1)
  float xx, xy, xz, yy, yz, zz;  ///< U, row by row, sqrt(h) / voxels; xx, yy, zz > 0
  float top;                     ///< h, the root of the weight: 1 if the weight is 1
};
static_assert(sizeof(LatticeKernel) == 52);

// N is summed in floats, here and on the device. Bounds on xi are widened by more than the rounding
// of xi and of a position (a share of the box, which thin kernels magnify, and of the distance to
// kernels). All roundings of h - |U d|^2 are shares of h and of |U d|^2, so xi's slack is one of h.
inline constexpr float kPositionSlack = 1e-5f;
inline constexpr float kDistanceSlack = 4e-7f;
inline constexpr float kXiSlack = 1e-4f;

/// A box around places that are evaluated, in voxels from an origin nearby.
struct PlaceBox {
  Vec3f centre, half;
};

/// Whether a kernel's support may reach the box, which is counted from `origin`, by the bound on xi
/// of octants.h.
inline bool reaches(const LatticeKernel& k, Coord origin, const PlaceBox& box) {
  const float dx = static_cast<float>(k.cell.x - origin.x) + k.offset.x - box.centre.x;
  const float dy = static_cast<float>(k.cell.y - origin.y) + k.offset.y - box.centre.y;
  const float dz = static_cast<float>(k.cell.z - origin.z) + k.offset.z - box.centre.z;
  const auto beyond = [](float middle, float extent) {
    return std::max(std::fabs(middle) - extent, 0.0f);
  };
  const Vec3f h = box.half;
  const float x = beyond(k.xx * dx + k.xy * dy + k.xz * dz,
                         k.xx * h.x + std::fabs(k.xy) * h.y + std::fabs(k.xz) * h.z);
  const float y = beyond(k.yy * dy + k.yz * dz, k.yy * h.y + std::fabs(k.yz) * h.z);
  const float z = beyond(k.zz * dz, k.zz * h.z);
  return x * x + y * y + z * z < k.top * (1.0f + kXiSlack);
}

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

/// A kernel around `centre` (model units) whose form is not set.
inline LatticeKernel to_lattice(Vec3d centre, float top, const Lattice& lattice) {
  const Vec3d local = lattice.local(centre);
  const Coord cell = cell_of(local);
  return {cell, Vec3f(local - to_vec3d(cell)), 0, 0, 0, 0, 0, 0, top};
}

/// The factor by which a weight enlarges U; taken from the rounded h, so that a support keeps its
/// radii.
inline double growth_of(float top) { return std::sqrt(static_cast<double>(top)); }

/// A kernel with radius `radius` (model units) in every direction.
inline LatticeKernel to_lattice(Vec3d centre, double radius, float top, const Lattice& lattice) {
  LatticeKernel local = to_lattice(centre, top, lattice);
  local.xx = local.yy = local.zz = static_cast<float>(growth_of(top) * lattice.voxel_size / radius);
  return local;
}

/// U is the R of a QR decomposition, by Gram-Schmidt on the columns of the axes: unlike a Cholesky
/// factor of U^T U it keeps its digits for thin kernels.
inline LatticeKernel to_lattice(Vec3d centre, const KernelForm& form, float top,
                                const Lattice& lattice) {
  LatticeKernel local = to_lattice(centre, top, lattice);
  const double scale = growth_of(top) * lattice.voxel_size;
  const Vec3d u = form.u * scale, v = form.v * scale, n = form.n * scale;
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

/// `falloff` is k, which determines the root of the weight.
inline LatticeKernel to_lattice(const Kernel& kernel, const Lattice& lattice, int falloff) {
  const float top = falloff_root(kernel.weight, falloff);
  return is_isotropic(kernel)
             ? to_lattice(kernel.centre, static_cast<double>(kernel.radius_major), top, lattice)
             : to_lattice(kernel.centre, form_of(kernel), top, lattice);
}

}  // namespace leafhull
