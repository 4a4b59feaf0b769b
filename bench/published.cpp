// SPDX-License-Identifier: Apache-2.0
#include "bench/published.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace leafhull::bench::published {
namespace {

/// A density function D_j: unit axes over their influencing bounds. Source: Eqs. (1), (3), (4).
struct DensityFunction {
  Vec3d centre;
  std::array<Vec3d, 3> axes;
  Vec3d extent;  // half the axis-aligned box of the support

  double at(Vec3d p) const {
    const Vec3d offset = p - centre;
    double xi = 0;
    for (const Vec3d& axis : axes) {
      const double along = dot(axis, offset);
      xi += along * along;
    }
    return xi < 1 ? (1 - xi) * (1 - xi) : 0;
  }
};

DensityFunction density_function(const Leaf& leaf, double u, double v, double n) {
  const std::array<Vec3d, 3> axis = {leaf.major, cross(leaf.normal, leaf.major), leaf.normal};
  const std::array<double, 3> radius = {u, v, n};
  DensityFunction d{leaf.position, {}, {}};
  for (int a = 0; a < 3; ++a) {
    d.axes[a] = axis[a] / radius[a];
    const Vec3d reach = axis[a] * radius[a];
    d.extent = d.extent + Vec3d(reach.x * reach.x, reach.y * reach.y, reach.z * reach.z);
  }
  d.extent = {std::sqrt(d.extent.x), std::sqrt(d.extent.y), std::sqrt(d.extent.z)};
  return d;
}

std::vector<DensityFunction> isotropic(std::span<const Leaf> leaves, double radius) {
  std::vector<DensityFunction> functions;
  functions.reserve(leaves.size());
  for (const Leaf& leaf : leaves) {
    functions.push_back(density_function(leaf, radius, radius, radius));
  }
  return functions;
}

double coordinate(const Grid& grid, int axis, std::size_t i) {
  return (static_cast<double>(grid.low[axis]) + static_cast<double>(i)) * grid.voxel;
}

/// Adds D_j to the cell vertices within its influencing bound.
void add(Grid& grid, const DensityFunction& d) {
  const std::array<double, 3> centre = {d.centre.x, d.centre.y, d.centre.z};
  const std::array<double, 3> extent = {d.extent.x, d.extent.y, d.extent.z};
  std::array<std::size_t, 3> first, end;
  for (int a = 0; a < 3; ++a) {
    const auto cell = [&](double v) {
      return static_cast<std::size_t>(static_cast<std::int64_t>(v) - grid.low[a]);
    };
    first[a] = cell(std::ceil((centre[a] - extent[a]) / grid.voxel));
    end[a] = cell(std::floor((centre[a] + extent[a]) / grid.voxel)) + 1;
  }
  for (std::size_t x = first[0]; x < end[0]; ++x) {
    for (std::size_t y = first[1]; y < end[1]; ++y) {
      for (std::size_t z = first[2]; z < end[2]; ++z) {
        grid.values[grid.index(x, y, z)] +=
            d.at({coordinate(grid, 0, x), coordinate(grid, 1, y), coordinate(grid, 2, z)});
      }
    }
  }
}

void sum_everywhere(Grid& grid, std::span<const DensityFunction> functions) {
  for (std::size_t x = 0; x < grid.count[0]; ++x) {
    for (std::size_t y = 0; y < grid.count[1]; ++y) {
      for (std::size_t z = 0; z < grid.count[2]; ++z) {
        const Vec3d p(coordinate(grid, 0, x), coordinate(grid, 1, y), coordinate(grid, 2, z));
        double n = 0;
        for (const DensityFunction& d : functions) n += d.at(p);
        grid.values[grid.index(x, y, z)] = n;
      }
    }
  }
}

void evaluate(Grid& grid, std::span<const DensityFunction> functions, bool literal) {
  grid.values.assign(grid.values.size(), 0);
  if (literal) {
    sum_everywhere(grid, functions);
  } else {
    for (const DensityFunction& d : functions) add(grid, d);
  }
}

std::vector<double> interpolated_at_leaves(const Grid& grid, std::span<const Leaf> leaves) {
  std::vector<double> density;
  density.reserve(leaves.size());
  for (const Leaf& leaf : leaves) density.push_back(interpolated(grid, leaf.position));
  return density;
}

/// Steps 3 to 5: p1 and p2, and the influencing bounds between R_max and the leaf's own. The spread
/// is the standard deviation, where the paper prints the variance, as leafhull reads it: the bounds
/// and with them the work are the same. Source: Eqs. (5) to (10).
std::vector<DensityFunction> controlled(std::span<const Leaf> leaves,
                                        std::span<const double> isotropic_density,
                                        const Parameters& parameters) {
  constexpr double kSmallestRadius = 1e-3;  // in units of R_max
  const auto count = static_cast<double>(leaves.size());
  double mean = 0, variance = 0;
  for (const double n : isotropic_density) mean += n / count;
  for (const double n : isotropic_density) variance += (n - mean) * (n - mean) / count;
  const double p1 = mean, p2 = mean + 2 * std::sqrt(variance);

  std::vector<DensityFunction> functions;
  functions.reserve(leaves.size());
  for (std::size_t j = 0; j < leaves.size(); ++j) {
    const double n = isotropic_density[j];
    const double share = n <= p1 ? 0 : n >= p2 ? 1 : (n - p1) / (p2 - p1);
    const auto bound = [&](double radius) {
      return std::clamp(parameters.radius_max + (radius - parameters.radius_max) * share,
                        kSmallestRadius * parameters.radius_max, parameters.radius_max);
    };
    functions.push_back(density_function(leaves[j], bound(leaves[j].radius_major),
                                         bound(leaves[j].radius_minor),
                                         bound(parameters.flatness * leaves[j].radius_minor)));
  }
  return functions;
}

}  // namespace

Grid set_grid(std::span<const Leaf> leaves, const Parameters& parameters) {
  Box box;
  const double reach = parameters.radius_max;
  for (const Leaf& leaf : leaves) box.include(leaf.position);
  Grid grid;
  grid.voxel = parameters.voxel;
  const std::array<double, 3> low = {box.low.x, box.low.y, box.low.z};
  const std::array<double, 3> high = {box.high.x, box.high.y, box.high.z};
  double vertices = 1;
  for (int a = 0; a < 3; ++a) {
    // A cell more on each side: the surface ends inside the grid.
    grid.low[a] = static_cast<std::int64_t>(std::floor((low[a] - reach) / grid.voxel)) - 1;
    const auto last = static_cast<std::int64_t>(std::ceil((high[a] + reach) / grid.voxel)) + 1;
    grid.count[a] = static_cast<std::size_t>(last - grid.low[a] + 1);
    vertices *= static_cast<double>(grid.count[a]);
  }
  if (vertices > 0x1p31) throw std::runtime_error("the dense grid does not fit in memory");
  grid.values.resize(grid.count[0] * grid.count[1] * grid.count[2]);
  return grid;
}

Grid density_field(std::span<const Leaf> leaves, const Parameters& parameters) {
  Grid grid = set_grid(leaves, parameters);
  const double radius_max = parameters.radius_max;
  evaluate(grid, isotropic(leaves, radius_max), parameters.literal);
  if (parameters.controlled) {
    const std::vector<double> density = interpolated_at_leaves(grid, leaves);
    evaluate(grid, controlled(leaves, density, parameters), parameters.literal);
  }
  return grid;
}

double interpolated(const Grid& grid, Vec3d p) {
  const std::array<double, 3> local = {p.x / grid.voxel - static_cast<double>(grid.low[0]),
                                       p.y / grid.voxel - static_cast<double>(grid.low[1]),
                                       p.z / grid.voxel - static_cast<double>(grid.low[2])};
  std::array<std::size_t, 3> cell;
  std::array<double, 3> f;
  for (int a = 0; a < 3; ++a) {
    cell[a] = static_cast<std::size_t>(local[a]);
    f[a] = local[a] - static_cast<double>(cell[a]);
  }
  double n = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    const std::size_t x = c >> 2 & 1, y = c >> 1 & 1, z = c & 1;
    n += (x ? f[0] : 1 - f[0]) * (y ? f[1] : 1 - f[1]) * (z ? f[2] : 1 - f[2]) *
         grid.values[grid.index(cell[0] + x, cell[1] + y, cell[2] + z)];
  }
  return n;
}

double threshold_for_coverage(const Grid& grid, std::span<const Leaf> leaves, double coverage) {
  std::vector<double> density = interpolated_at_leaves(grid, leaves);
  const auto below = static_cast<std::size_t>((1 - coverage) * static_cast<double>(leaves.size()));
  const auto at = density.begin() + static_cast<std::ptrdiff_t>(std::min(below, leaves.size() - 1));
  std::nth_element(density.begin(), at, density.end());
  return *at;
}

}  // namespace leafhull::bench::published
