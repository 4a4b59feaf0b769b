// SPDX-License-Identifier: Apache-2.0
#include "points/even_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace leafhull {
namespace {

/// Cells along each side of a chart's grid: from the coarsest grid to the finest.
constexpr int kCoarsestGrid = 16;
constexpr int kFinestGrid = 4096;

/// Which cells of a grid over [low, low + size] have their middle in a triangle.
void mark(const std::array<Vec2d, 3>& triangle, Vec2d low, Vec2d size, int edge,
          std::vector<bool>& marked) {
  const auto [a, b, c] = triangle;
  const double turn = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  const auto left_of = [turn](Vec2d p, Vec2d from, Vec2d to) {
    return ((to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x)) * turn >= 0;
  };
  const auto cells = [edge](double least, double most, double from, double length) {
    const auto at = [&](double v) { return (v - from) / length * edge - 0.5; };
    return std::pair(std::max(0, static_cast<int>(std::ceil(at(least)))),
                     std::min(edge - 1, static_cast<int>(std::floor(at(most)))));
  };
  const auto [x0, x1] = cells(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), low.x, size.x);
  const auto [y0, y1] = cells(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), low.y, size.y);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const Vec2d p{low.x + (x + 0.5) / edge * size.x, low.y + (y + 0.5) / edge * size.y};
      if (left_of(p, a, b) && left_of(p, b, c) && left_of(p, c, a)) {
        marked[static_cast<std::size_t>(y) * edge + x] = true;
      }
    }
  }
}

std::vector<Vec2d> grid_samples(const LeafChart& chart, Vec2d low, Vec2d size, int edge) {
  std::vector<bool> marked(static_cast<std::size_t>(edge) * edge);
  for (const auto& triangle : chart.triangles) mark(triangle, low, size, edge, marked);
  std::vector<Vec2d> samples;
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      if (!marked[static_cast<std::size_t>(y) * edge + x]) continue;
      const Vec2d p{low.x + (x + 0.5) / edge * size.x, low.y + (y + 0.5) / edge * size.y};
      if (!chart.mask || chart.mask->keeps(p)) samples.push_back(p);
    }
  }
  return samples;
}

}  // namespace

std::vector<Vec2d> even_samples(const LeafChart& chart, std::size_t least) {
  Vec2d low = chart.triangles.front().front(), high = low;
  for (const auto& triangle : chart.triangles) {
    for (const Vec2d p : triangle) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  const Vec2d size{high.x - low.x, high.y - low.y};
  std::vector<Vec2d> samples;
  if (size.x > 0 && size.y > 0) {
    for (int edge = kCoarsestGrid; edge <= kFinestGrid;) {
      samples = grid_samples(chart, low, size, edge);
      if (samples.size() >= least) break;
      const double finer = std::sqrt(static_cast<double>(least) /
                                     static_cast<double>(std::max<std::size_t>(samples.size(), 1)));
      edge = static_cast<int>(std::ceil(edge * std::clamp(1.05 * finer, 1.1, 4.0)));
    }
  }
  if (samples.empty()) samples.push_back(chart.centre);
  return samples;
}

}  // namespace leafhull
