// SPDX-License-Identifier: Apache-2.0
#include "voxels.h"

#include <algorithm>
#include <cmath>

namespace recount {
namespace {

void count(Count& count, bool certain, bool exact, bool possible) {
  count.low += certain;
  count.exact += exact;
  count.high += possible;
}

/// Whether each cell holds a leaf vertex: exactly in float64, and certainly or possibly after the
/// vertex is rounded to float32 (a vertex close to a cell's face may lie in either cell).
struct Held {
  std::vector<bool> certain, exact, possible;
};

Held held_cells(const Lattice& lattice, const std::vector<Point>& vertices) {
  const std::size_t size = lattice.values.size();
  Held held{std::vector<bool>(size), std::vector<bool>(size), std::vector<bool>(size)};
  for (const Point& vertex : vertices) {
    std::array<long, 3> low, cell, high;
    for (int i = 0; i < 3; ++i) {
      const double c = vertex[i] / lattice.voxel_size;
      const double slack = std::abs(c) * 0x1p-24;
      low[i] = std::lround(std::floor(c - slack));
      cell[i] = std::lround(std::floor(c));
      high[i] = std::lround(std::floor(c + slack));
    }
    held.exact[lattice.index(cell[0], cell[1], cell[2])] = true;
    if (low == high) held.certain[lattice.index(cell[0], cell[1], cell[2])] = true;
    for (long i = low[0]; i <= high[0]; ++i) {
      for (long j = low[1]; j <= high[1]; ++j) {
        for (long k = low[2]; k <= high[2]; ++k) held.possible[lattice.index(i, j, k)] = true;
      }
    }
  }
  return held;
}

/// How many of a cell's corners are inside: in float64, and certainly and possibly after rounding.
Count inside_corners(const Lattice& lattice, long i, long j, long k, double threshold) {
  Count corners;
  for (int corner = 0; corner < 8; ++corner) {
    const double value =
        lattice.values[lattice.index(i + (corner >> 2), j + (corner >> 1 & 1), k + (corner & 1))];
    count(corners, value >= threshold * (1 + kRounding), value >= threshold,
          value >= threshold * (1 - kRounding));
  }
  return corners;
}

void mark_corners(const Lattice& lattice, long i, long j, long k, std::vector<bool>& marks) {
  for (int corner = 0; corner < 8; ++corner) {
    marks[lattice.index(i + (corner >> 2), j + (corner >> 1 & 1), k + (corner & 1))] = true;
  }
}

}  // namespace

VoxelCounts count_voxels(const Lattice& lattice, const std::vector<Point>& vertices,
                         double threshold) {
  const Held held = held_cells(lattice, vertices);
  const auto [low, size] = std::pair{lattice.low, lattice.count};
  std::vector<bool> beside_surface(lattice.values.size());
  VoxelCounts counts;
  for (long i = low[0]; i < low[0] + size[0] - 1; ++i) {
    for (long j = low[1]; j < low[1] + size[1] - 1; ++j) {
      for (long k = low[2]; k < low[2] + size[2] - 1; ++k) {
        const Count corners = inside_corners(lattice, i, j, k, threshold);
        if (corners.high == 0) continue;
        const std::size_t cell = lattice.index(i, j, k);
        const bool surely_on = corners.low > 0 && corners.high < 8;
        count(counts.inside, corners.low == 8, corners.exact == 8, corners.high == 8);
        count(counts.on, surely_on, corners.exact > 0 && corners.exact < 8, corners.low < 8);
        count(counts.dilated, corners.low > 0 && !held.possible[cell],
              corners.exact > 0 && !held.exact[cell], !held.certain[cell]);
        if (surely_on) mark_corners(lattice, i, j, k, beside_surface);
      }
    }
  }
  counts.samples_beside_surface =
      std::uint64_t(std::count(beside_surface.begin(), beside_surface.end(), true));
  return counts;
}

Count count_below(const std::vector<double>& values, double threshold) {
  Count below;
  for (double value : values) {
    count(below, value < threshold * (1 - kRounding), value < threshold,
          value < threshold * (1 + kRounding));
  }
  return below;
}

}  // namespace recount
