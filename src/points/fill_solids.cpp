// SPDX-License-Identifier: Apache-2.0
#include "points/fill_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

namespace leafhull {
namespace {

/// A cell's edge over the spacing.
constexpr double kCellOverSpacing = 1.1;
/// Radii of the points over that edge: above R_max however flat leaves are, to which control then
/// caps them. What is filled in has no shape of its own.
constexpr double kRound = 8;
/// Samples along a cell's edge.
constexpr int kSamplesPerCell = 4;
/// A surface is filled from this thickness over the spacing on, about half of R_max.
constexpr double kThick = 1.5;

using Triangle = std::array<Vec3d, 3>;

/// Where a line along x crosses a closed surface: at places of a lattice in y and z.
class Crossings {
 public:
  Crossings(const LeafSolid& solid, double step) : step_(step) {
    for (const Triangle& triangle : solid.triangles) add(triangle);
    for (auto& [line, at] : lines_) std::ranges::sort(at);
  }

  /// By line, (y, z) in steps; ascending, an even number each.
  const std::map<std::pair<std::int64_t, std::int64_t>, std::vector<double>>& lines() const {
    return lines_;
  }

 private:
  /// Of the point (y, z) against the edge from a to b, seen along x: the same number for both
  /// triangles that share an edge, but for its sign, so that a line meets neither or one of them.
  static double side(const Vec3d& a, const Vec3d& b, double y, double z) {
    const bool turned = std::pair(b.y, b.z) < std::pair(a.y, a.z);
    const Vec3d &from = turned ? b : a, &to = turned ? a : b;
    const double s = (to.y - from.y) * (z - from.z) - (to.z - from.z) * (y - from.y);
    // A point on the line counts as on one side of it.
    const double sided = s == 0 ? std::numeric_limits<double>::min() : s;
    return turned ? -sided : sided;
  }

  void add(const Triangle& t) {
    const auto [a, b, c] = t;
    const auto low = [&](double v) { return std::llround(std::ceil(v / step_ - 0.5)); };
    const auto high = [&](double v) { return std::llround(std::floor(v / step_ - 0.5)); };
    const Vec3d normal = cross(b - a, c - a);
    if (normal.x == 0) return;  // seen from its edge
    for (auto i = low(std::min({a.y, b.y, c.y})); i <= high(std::max({a.y, b.y, c.y})); ++i) {
      const double y = (static_cast<double>(i) + 0.5) * step_;
      for (auto k = low(std::min({a.z, b.z, c.z})); k <= high(std::max({a.z, b.z, c.z})); ++k) {
        const double z = (static_cast<double>(k) + 0.5) * step_;
        const bool ab = side(a, b, y, z) > 0, bc = side(b, c, y, z) > 0, ca = side(c, a, y, z) > 0;
        if (ab != bc || bc != ca) continue;
        const double along = normal.y * (y - a.y) + normal.z * (z - a.z);
        const double x = a.x - along / normal.x;
        lines_[{i, k}].push_back(
            std::clamp(x, std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x})));
      }
    }
  }

  double step_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<double>> lines_;
};

/// The samples of a solid in a cell.
struct Cell {
  std::uint64_t count = 0;
  Vec3d sum;  // steps
};

using Cells = std::map<std::array<std::int64_t, 3>, Cell>;

Cells cells_of(const LeafSolid& solid, double step) {
  const auto cell = [](std::int64_t i) {
    return (i - (i % kSamplesPerCell + kSamplesPerCell) % kSamplesPerCell) / kSamplesPerCell;
  };
  Cells cells;
  const Crossings crossings(solid, step);
  for (const auto& [line, at] : crossings.lines()) {
    const auto [y, z] = line;
    for (std::size_t pair = 0; pair + 1 < at.size(); pair += 2) {
      const auto first = std::llround(std::ceil(at[pair] / step - 0.5));
      const auto last = std::llround(std::floor(at[pair + 1] / step - 0.5));
      for (auto x = first; x <= last; ++x) {
        Cell& found = cells[{cell(x), cell(y), cell(z)}];
        ++found.count;
        found.sum = found.sum + Vec3d(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5,
                                      static_cast<double>(z) + 0.5);
      }
    }
  }
  return cells;
}

}  // namespace

bool is_filled(const LeafSolid& solid, double spacing) {
  return solid.thickness() > kThick * spacing;
}

std::vector<LeafPoint> fill(const LeafSolid& solid, double spacing) {
  const double edge = kCellOverSpacing * spacing;
  const double step = edge / kSamplesPerCell;
  const Cells cells = cells_of(solid, step);
  std::uint64_t all = 0;
  for (const auto& [at, cell] : cells) all += cell.count;
  const auto radius = static_cast<float>(kRound * edge);
  std::vector<LeafPoint> points;
  points.reserve(cells.size());
  for (const auto& [at, cell] : cells) {
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
