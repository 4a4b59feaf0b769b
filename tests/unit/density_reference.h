// SPDX-License-Identifier: Apache-2.0
// The density in float64, straight from the equations, and kernels to test it with.
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include "density/spatial_hash.h"
#include "leafhull/shape.h"

namespace leafhull::reference {

/// xi_j(p). Source: Eq. (3).
inline double xi(const Kernel& kernel, Vec3d p) {
  const Vec3d d = p - kernel.centre;
  const Vec3d n(kernel.normal), u(kernel.major), v = cross(n, u);
  const double pu = dot(d, u) / static_cast<double>(kernel.radius_major);
  const double pv = dot(d, v) / static_cast<double>(kernel.radius_minor);
  const double pn = dot(d, n) / static_cast<double>(kernel.radius_normal);
  return pu * pu + pv * pv + pn * pn;
}

/// N(p). SPEC: 2; Source: Eqs. (1), (2), (4).
inline double density(std::span<const Kernel> kernels, Vec3d p, int k) {
  double sum = 0;
  for (const Kernel& kernel : kernels) {
    const double x = xi(kernel, p);
    if (x < 1) sum += static_cast<double>(kernel.weight) * std::pow(1 - x, k);
  }
  return sum;
}

/// The sum of the weights of kernels that reach p or nearly do; rounding is a share of it.
inline double weight_near(std::span<const Kernel> kernels, Vec3d p) {
  double sum = 0;
  for (const Kernel& kernel : kernels) {
    if (xi(kernel, p) < 1.001) sum += static_cast<double>(kernel.weight);
  }
  return sum;
}

inline Kernel sphere(Vec3d centre, float radius, float weight = 1) {
  return {centre, {0, 0, 1}, {1, 0, 0}, radius, radius, radius, weight};
}

/// `count` kernels with random frames in a cube of edge `extent` and radii from `smallest` to 1.
inline std::vector<Kernel> random_kernels(std::size_t count, double extent, float smallest = 0.2f,
                                          Vec3d corner = {}) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<float> gauss;
  std::vector<Kernel> kernels;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3f n = normalized(Vec3f(gauss(random), gauss(random), gauss(random)));
    const Vec3f other(gauss(random), gauss(random), gauss(random));
    const Vec3f u = normalized(other - n * dot(n, other));
    const auto radius = [&] {
      return smallest + (1 - smallest) * static_cast<float>(unit(random));
    };
    kernels.push_back({corner + Vec3d(unit(random), unit(random), unit(random)) * extent, n, u,
                       radius(), radius(), radius()});
  }
  return kernels;
}

/// The kernels with weights from 10^-decades to 10^decades.
inline std::vector<Kernel> weighted(std::vector<Kernel> kernels, double decades) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> power(-decades, decades);
  for (Kernel& kernel : kernels) kernel.weight = static_cast<float>(std::pow(10, power(random)));
  return kernels;
}

/// A spatial hash of kernels with radii up to 1.
inline std::shared_ptr<const SpatialHash> hash_of(std::span<const Kernel> kernels) {
  return std::make_shared<const SpatialHash>(kernels, Lattice::near(kernels.front().centre, 1));
}

}  // namespace leafhull::reference
