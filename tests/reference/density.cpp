// SPDX-License-Identifier: Apache-2.0
#include "density.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace recount {
namespace {

double power(double base, int exponent) {
  double result = 1;
  for (int i = 0; i < exponent; ++i) result *= base;
  return result;
}

/// The offset p - c in the kernel's axes, in radii.
Point local(const Kernel& kernel, const Point& offset) {
  Point q;
  for (int a = 0; a < 3; ++a) {
    const Point& axis = kernel.scaled_axes[a];
    q[a] = axis[0] * offset[0] + axis[1] * offset[1] + axis[2] * offset[2];
  }
  return q;
}

double squared_length(const Point& q) { return q[0] * q[0] + q[1] * q[1] + q[2] * q[2]; }

void add(const Kernel& kernel, int falloff, Lattice& lattice) {
  const double h = lattice.voxel_size;
  std::array<long, 3> first, last;
  for (int i = 0; i < 3; ++i) {
    first[i] = std::lround(std::floor((kernel.centre[i] - kernel.extents[i]) / h));
    last[i] = std::lround(std::ceil((kernel.centre[i] + kernel.extents[i]) / h));
  }
  Point offset;
  for (long i = first[0]; i <= last[0]; ++i) {
    offset[0] = double(i) * h - kernel.centre[0];
    for (long j = first[1]; j <= last[1]; ++j) {
      offset[1] = double(j) * h - kernel.centre[1];
      double* row = &lattice.values[lattice.index(i, j, first[2])];
      for (long k = first[2]; k <= last[2]; ++k, ++row) {
        offset[2] = double(k) * h - kernel.centre[2];
        const double xi = squared_length(local(kernel, offset));
        if (xi < 1) *row += kernel.weight * power(1 - xi, falloff);
      }
    }
  }
}

void add(const Kernel& kernel, int falloff, const Point& point, Density& density) {
  Point offset;
  for (int i = 0; i < 3; ++i) {
    offset[i] = point[i] - kernel.centre[i];
    if (std::abs(offset[i]) > kernel.extents[i]) return;
  }
  const Point q = local(kernel, offset);
  const double xi = squared_length(q);
  if (xi >= 1) return;
  const double slope = -falloff * kernel.weight * power(1 - xi, falloff - 1);
  density.value += kernel.weight * power(1 - xi, falloff);
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 3; ++a) density.gradient[i] += slope * 2 * q[a] * kernel.scaled_axes[a][i];
  }
}

/// Points cut into slices along x and sorted by y in each, to find those in a kernel's box.
class SortedPoints {
 public:
  SortedPoints(const std::vector<Point>& points, double slice_width)
      : points_(points), slice_width_(slice_width) {
    for (std::size_t i = 0; i < points.size(); ++i) slices_[slice_at(points[i][0])].push_back(i);
    for (auto& [x, slice] : slices_) {
      std::sort(slice.begin(), slice.end(),
                [&](std::size_t a, std::size_t b) { return points[a][1] < points[b][1]; });
    }
  }

  template <class Visit>
  void visit_box(const Point& centre, const Point& extents, Visit visit) const {
    const auto last = slices_.upper_bound(slice_at(centre[0] + extents[0]));
    for (auto s = slices_.lower_bound(slice_at(centre[0] - extents[0])); s != last; ++s) {
      const std::vector<std::size_t>& slice = s->second;
      const double low = centre[1] - extents[1], high = centre[1] + extents[1];
      auto next = std::partition_point(slice.begin(), slice.end(),
                                       [&](std::size_t i) { return points_[i][1] < low; });
      for (; next != slice.end() && points_[*next][1] <= high; ++next) visit(*next);
    }
  }

 private:
  double slice_at(double x) const { return std::floor(x / slice_width_); }

  const std::vector<Point>& points_;
  double slice_width_;
  std::map<double, std::vector<std::size_t>> slices_;
};

}  // namespace

Kernel make_kernel(const Point& centre, const std::array<Point, 3>& axes, const Point& radii,
                   double weight) {
  Kernel kernel{centre, axes, {}, weight};
  for (int i = 0; i < 3; ++i) {
    double sum = 0;
    for (int a = 0; a < 3; ++a) {
      kernel.scaled_axes[a][i] = axes[a][i] / radii[a];
      sum += axes[a][i] * radii[a] * axes[a][i] * radii[a];
    }
    kernel.extents[i] = std::sqrt(sum);
  }
  return kernel;
}

double Lattice::trilinear(const Point& p) const {
  std::array<long, 3> cell;
  Point t;
  for (int i = 0; i < 3; ++i) {
    cell[i] = std::lround(std::floor(p[i] / voxel_size));
    t[i] = p[i] / voxel_size - double(cell[i]);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner >> 2, j = corner >> 1 & 1, k = corner & 1;
    const double weight = (i ? t[0] : 1 - t[0]) * (j ? t[1] : 1 - t[1]) * (k ? t[2] : 1 - t[2]);
    sum += weight * values[index(cell[0] + i, cell[1] + j, cell[2] + k)];
  }
  return sum;
}

Lattice sum_on_lattice(const std::vector<Kernel>& kernels, int falloff, double voxel_size) {
  Lattice lattice{voxel_size, {}, {}, {}};
  for (int i = 0; i < 3; ++i) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Kernel& kernel : kernels) {
      low = std::min(low, kernel.centre[i] - kernel.extents[i]);
      high = std::max(high, kernel.centre[i] + kernel.extents[i]);
    }
    lattice.low[i] = std::lround(std::floor(low / voxel_size)) - 1;
    lattice.count[i] = std::lround(std::ceil(high / voxel_size)) + 2 - lattice.low[i];
  }
  lattice.values.resize(std::size_t(lattice.count[0]) * lattice.count[1] * lattice.count[2]);
  for (const Kernel& kernel : kernels) add(kernel, falloff, lattice);
  return lattice;
}

std::vector<Density> sum_at(const std::vector<Point>& points, const std::vector<Kernel>& kernels,
                            int falloff) {
  double widest = 0;
  for (const Kernel& kernel : kernels) widest = std::max(widest, kernel.extents[0]);
  const SortedPoints sorted(points, widest / 4);
  std::vector<Density> densities(points.size());
  for (const Kernel& kernel : kernels) {
    sorted.visit_box(kernel.centre, kernel.extents,
                     [&](std::size_t i) { add(kernel, falloff, points[i], densities[i]); });
  }
  return densities;
}

}  // namespace recount
