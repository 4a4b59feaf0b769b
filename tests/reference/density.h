// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

namespace recount {

using Point = std::array<double, 3>;

inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A density function. `scaled_axes` are the unit axes u, v, n, each divided by its radius, so that
/// xi is the squared length of the offset in them; `extents` is the half size of the tight
/// axis-aligned box of its support. D = weight (1 - xi)^k. SPEC: 2; Source: Eqs. (1), (3), (4).
struct Kernel {
  Point centre;
  std::array<Point, 3> scaled_axes;
  Point extents;
  double weight;
};

Kernel make_kernel(const Point& centre, const std::array<Point, 3>& axes, const Point& radii,
                   double weight);

struct Density {
  double value = 0;
  Point gradient{};
};

/// N at every sample of a box of the lattice {(i, j, k) h}.
struct Lattice {
  double voxel_size = 0;
  std::array<long, 3> low{}, count{};
  std::vector<double> values;  ///< k varies fastest

  std::size_t index(long i, long j, long k) const {
    return (std::size_t(i - low[0]) * count[1] + (j - low[1])) * count[2] + (k - low[2]);
  }
  double trilinear(const Point& p) const;
};

/// N on the lattice over the union of the supports, grown by a cell.
Lattice sum_on_lattice(const std::vector<Kernel>& kernels, int falloff, double voxel_size);

/// N and its gradient at each point.
std::vector<Density> sum_at(const std::vector<Point>& points, const std::vector<Kernel>& kernels,
                            int falloff);

}  // namespace recount
