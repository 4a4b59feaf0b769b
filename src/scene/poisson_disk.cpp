// SPDX-License-Identifier: Apache-2.0
#include "scene/poisson_disk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace leafhull {
namespace {

/// Tries per point. Bridson's k is 30, in an annulus; these are in a square, of which the annulus
/// takes 3 pi / 16, or more inside a narrow area.
constexpr int kTries = 50;

/// The distance of a full pattern in units of sqrt(area / count), chosen so that few points are
/// left over.
constexpr double kDistance = 0.78;
constexpr double kCloser = 0.98;

/// Points in cells too small to hold two, with a margin of two empty cells.
class Grid {
 public:
  Grid(Vec2d area, double distance)
      : area_(area),
        squared_distance_(distance * distance),
        cell_(distance / std::numbers::sqrt2),
        columns_(cells(area.x)),
        points_(static_cast<std::size_t>(columns_ * cells(area.y)), kNone) {
    for (std::size_t i = 0; i < kReach.size(); ++i) {
      reach_[i] = kReach[i].row * columns_ + kReach[i].column;
    }
  }

  /// Adds a point of the first quadrant unless it is outside or too near another.
  bool add(Vec2d p, std::vector<Vec2d>& points) {
    if (p.x >= area_.x || p.y >= area_.y) return false;
    const std::int64_t cell = cell_of(p.y) * columns_ + cell_of(p.x);
    for (const std::int64_t offset : reach_) {
      const std::uint32_t other = points_[static_cast<std::size_t>(cell + offset)];
      if (other == kNone) continue;
      const double dx = points[other].x - p.x, dy = points[other].y - p.y;
      if (dx * dx + dy * dy < squared_distance_) return false;
    }
    points_[static_cast<std::size_t>(cell)] = static_cast<std::uint32_t>(points.size());
    points.push_back(p);
    return true;
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;
  static constexpr std::int64_t kMargin = 2;

  /// The cells that a point's disk reaches, those most likely to hold a conflict first.
  struct Step {
    int row, column;
  };
  static constexpr std::array<Step, 21> kReach{
      {{0, 0},  {0, -1}, {0, 1},  {-1, 0},  {1, 0},  {-1, -1}, {-1, 1},
       {1, -1}, {1, 1},  {0, -2}, {0, 2},   {-2, 0}, {2, 0},   {-1, -2},
       {-1, 2}, {1, -2}, {1, 2},  {-2, -1}, {-2, 1}, {2, -1},  {2, 1}}};

  std::int64_t cell_of(double x) const { return static_cast<std::int64_t>(x / cell_) + kMargin; }
  std::int64_t cells(double side) const { return cell_of(side) + 1 + kMargin; }

  Vec2d area_;
  double squared_distance_, cell_;
  std::int64_t columns_;
  std::vector<std::uint32_t> points_;
  std::array<std::int64_t, kReach.size()> reach_{};
};

/// A point of the area at most two distances from `centre` along each axis.
Vec2d candidate(Vec2d centre, Vec2d area, double distance, Random& random) {
  const auto along = [&](double c, double side) {
    return random.number(std::max(c - 2 * distance, 0.), std::min(c + 2 * distance, side));
  };
  return {along(centre.x, area.x), along(centre.y, area.y)};
}

bool in_annulus(Vec2d p, Vec2d centre, double distance) {
  const double dx = p.x - centre.x, dy = p.y - centre.y;
  const double squared = (dx * dx + dy * dy) / (distance * distance);
  return squared >= 1 && squared <= 4;
}

std::vector<Vec2d> fill(Vec2d area, double distance, Random& random) {
  Grid grid(area, distance);
  std::vector<Vec2d> points;
  grid.add({random.number(0, area.x), random.number(0, area.y)}, points);
  std::vector<std::uint32_t> active(points.size(), 0);
  while (!active.empty()) {
    const std::size_t chosen = random.index(active.size());
    const Vec2d centre = points[active[chosen]];
    bool added = false;
    for (int i = 0; i < kTries && !added; ++i) {
      const Vec2d p = candidate(centre, area, distance, random);
      added = in_annulus(p, centre, distance) && grid.add(p, points);
    }
    if (added) {
      active.push_back(static_cast<std::uint32_t>(points.size() - 1));
    } else {
      active[chosen] = active.back();
      active.pop_back();
    }
  }
  return points;
}

/// Keeps `count` of the points in their order; each subset is equally likely.
/// Source: Knuth, The Art of Computer Programming 2, 3.4.2, Algorithm S.
void thin_out(std::vector<Vec2d>& points, std::size_t count, Random& random) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (random.index(points.size() - i) < count - kept) points[kept++] = points[i];
  }
  points.resize(kept);
}

}  // namespace

Disks poisson_disks(Vec2d area, std::size_t count, Random& random) {
  double distance = kDistance * std::sqrt(area.x) * std::sqrt(area.y / static_cast<double>(count));
  std::vector<Vec2d> points = fill(area, distance, random);
  while (points.size() < count) {
    distance *= kCloser;
    points = fill(area, distance, random);
  }
  thin_out(points, count, random);
  return {std::move(points), distance};
}

}  // namespace leafhull
