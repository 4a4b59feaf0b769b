// SPDX-License-Identifier: Apache-2.0
#include "points/fill_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <set>
#include <unordered_map>
#include <utility>

#include "leafhull/error.h"
#include "text/numbers.h"

namespace leafhull {
namespace {

/// A surface is filled if its thickness over R_max is larger than this.
constexpr double kThick = 0.5;
/// A cell's edge over R_max, and samples along it.
constexpr double kCellOverRadius = 0.28;
constexpr int kSamplesPerCell = 4;
constexpr std::uint64_t kSamplesOfCell = kSamplesPerCell * kSamplesPerCell * kSamplesPerCell;
/// Radii of the points over R_max. Control caps them at R_max, however flat it makes other kernels:
/// the filling has no shape of its own.
constexpr double kRound = 1e3;
/// If there are more cells than this, those deep inside are joined eight to one.
constexpr std::size_t kManyCells = 100'000;
constexpr double kMostCells = 10'000'000;
/// Kernels deeper than this over R_max do not reach the surface.
constexpr double kDeep = 2;

using Triangle = std::array<Vec3d, 3>;
using Key = std::array<std::int32_t, 3>;

struct Hash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t h = 0x243f6a88;
    for (const std::int32_t v : key) {
      h = (h ^ static_cast<std::uint32_t>(v)) * 0x9e3779b97f4a7c15;
      h ^= h >> 29;
    }
    return h;
  }
};

/// The samples of a solid in a cell.
struct Cell {
  std::uint64_t count = 0;
  Vec3d sum;  // steps
};
using Cells = std::unordered_map<Key, Cell, Hash>;

/// Where a line along x through a lattice point in y and z meets a surface.
struct Crossing {
  std::int32_t y, z;  // steps
  double x;           // model units
  auto operator<=>(const Crossing&) const = default;
};

/// On which side of the edge from a to b the point (y, z) lies, seen along x. The two triangles at
/// an edge get the same number but for its sign, so that a line meets exactly one or neither.
double side(const Vec3d& a, const Vec3d& b, double y, double z) {
  const bool turned = std::pair(b.y, b.z) < std::pair(a.y, a.z);
  const Vec3d &from = turned ? b : a, &to = turned ? a : b;
  const double s = (to.y - from.y) * (z - from.z) - (to.z - from.z) * (y - from.y);
  const double sided = s == 0 ? std::numeric_limits<double>::min() : s;
  return turned ? -sided : sided;
}

/// The first and the last sample from `low` to `high`.
std::pair<std::int32_t, std::int32_t> samples_between(double low, double high, double step) {
  return {static_cast<std::int32_t>(std::ceil(low / step - 0.5)),
          static_cast<std::int32_t>(std::floor(high / step - 0.5))};
}

double at(std::int32_t sample, double step) { return (sample + 0.5) * step; }

void cross_triangle(const Triangle& triangle, double step, std::vector<Crossing>& crossings) {
  const auto& [a, b, c] = triangle;
  const Vec3d normal = cross(b - a, c - a);
  if (normal.x == 0) return;  // seen edge-on
  const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
  const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
  const auto [low_z, high_z] = std::minmax({a.z, b.z, c.z});
  const auto [first_y, last_y] = samples_between(low_y, high_y, step);
  const auto [first_z, last_z] = samples_between(low_z, high_z, step);
  for (std::int32_t i = first_y; i <= last_y; ++i) {
    const double y = at(i, step);
    for (std::int32_t k = first_z; k <= last_z; ++k) {
      const double z = at(k, step);
      const bool ab = side(a, b, y, z) > 0, bc = side(b, c, y, z) > 0, ca = side(c, a, y, z) > 0;
      if (ab != bc || bc != ca) continue;
      const double x = a.x - (normal.y * (y - a.y) + normal.z * (z - a.z)) / normal.x;
      crossings.push_back({i, k, std::clamp(x, low_x, high_x)});
    }
  }
}

Key cell_of_sample(std::int32_t x, std::int32_t y, std::int32_t z) {
  static_assert(kSamplesPerCell == 4);
  return {x >> 2, y >> 2, z >> 2};
}

/// The cells of the world's lattice that a solid meets. Along a line, every second crossing leaves
/// the solid.
Cells cells_of(const LeafSolid& solid, double step) {
  std::vector<Crossing> crossings;
  for (const Triangle& triangle : solid.triangles) cross_triangle(triangle, step, crossings);
  std::ranges::sort(crossings);
  Cells cells;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    const Crossing &in = crossings[i], &out = crossings[i + 1];
    const auto [first, last] = samples_between(in.x, out.x, step);
    for (std::int32_t x = first; x <= last; ++x) {
      Cell& cell = cells[cell_of_sample(x, in.y, in.z)];
      ++cell.count;
      cell.sum = cell.sum + Vec3d(x + 0.5, in.y + 0.5, in.z + 0.5);
    }
  }
  return cells;
}

/// Whether all six neighbours of a cell are among `cells`.
template <class Set>
bool is_inside(const Set& cells, const Key& key) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      Key neighbour = key;
      neighbour[axis] += step;
      if (!cells.contains(neighbour)) return false;
    }
  }
  return true;
}

/// Joins cells deep inside, eight to one.
Cells joined_inside(const Cells& cells) {
  std::set<Key> deep;
  for (const auto& [key, cell] : cells) {
    if (cell.count == kSamplesOfCell) deep.insert(key);
  }
  const int layers = static_cast<int>(std::ceil(kDeep / kCellOverRadius));
  for (int layer = 0; layer < layers; ++layer) {
    std::set<Key> deeper;
    for (const Key& key : deep) {
      if (is_inside(deep, key)) deeper.insert(deeper.end(), key);
    }
    deep = std::move(deeper);
  }
  // Large cells get keys that no other cell has.
  Cells joined;
  for (const auto& [key, cell] : cells) {
    constexpr std::int32_t kLarge = 1 << 30;
    const Key large{(key[0] >> 1) + kLarge, key[1] >> 1, key[2] >> 1};
    Cell& sum = joined[deep.contains(key) ? large : key];
    sum.count += cell.count;
    sum.sum = sum.sum + cell.sum;
  }
  return joined;
}

}  // namespace

bool is_filled(const LeafSolid& solid, double radius_max) {
  return solid.thickness() > kThick * radius_max;
}

std::vector<LeafPoint> fill(const LeafSolid& solid, double radius_max) {
  const double edge = kCellOverRadius * radius_max;
  if (const double cells = solid.volume / (edge * edge * edge); !(cells <= kMostCells)) {
    throw Error(ErrorCode::usage,
                "a crown would be filled with " + significant(cells, 3) +
                    " leaf points, more than ten million",
                "Raise --radius-max.");
  }
  const double step = edge / kSamplesPerCell;
  Cells cells = cells_of(solid, step);
  if (cells.size() > kManyCells) cells = joined_inside(cells);
  std::vector<std::pair<Key, Cell>> sorted(cells.begin(), cells.end());
  std::ranges::sort(sorted, {}, &std::pair<Key, Cell>::first);
  std::uint64_t all = 0;
  for (const auto& [key, cell] : sorted) all += cell.count;
  const auto radius = static_cast<float>(kRound * radius_max);
  std::vector<LeafPoint> points;
  points.reserve(sorted.size());
  for (const auto& [key, cell] : sorted) {
    const auto count = static_cast<double>(cell.count);
    points.push_back({cell.sum * (step / count),
                      {0, 1, 0},
                      {1, 0, 0},
                      radius,
                      radius,
                      solid.area * count / static_cast<double>(all)});
  }
  return points;
}

}  // namespace leafhull
