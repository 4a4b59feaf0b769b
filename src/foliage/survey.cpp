// SPDX-License-Identifier: Apache-2.0
#include "foliage/survey.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "foliage/appearance.h"
#include "leaves/leaf_components.h"

namespace leafhull {
namespace {

constexpr std::size_t kSamples = 400'000;  // of the image, per primitive

/// Sums over the triangles of a piece.
struct Sums {
  Eigen::Vector3d origin;  ///< a vertex, about which the sums are
  double area = 0, volume = 0, kept = 0, spread = 0;
  Vec3d colour;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  double level = 0;  ///< area seen from above
  Box box;
  std::size_t triangles = 0;
};

Eigen::Vector3d to_eigen3(Vec3d v) { return {v.x, v.y, v.z}; }

void add(const std::array<Vec3d, 3>& corners, double area, const Shown& shown, Sums& sums) {
  if (sums.triangles++ == 0) sums.origin = to_eigen3(corners[0]);
  const Eigen::Vector3d p = to_eigen3(corners[0]) - sums.origin,
                        q = to_eigen3(corners[1]) - sums.origin,
                        r = to_eigen3(corners[2]) - sums.origin;
  const Eigen::Vector3d sum = p + q + r;
  sums.area += area;
  sums.volume += p.dot(q.cross(r)) / 6;
  sums.level += std::abs((q - p).cross(r - p).y()) / 2;
  sums.first += area / 3 * sum;
  sums.second +=
      area / 12 *
      (p * p.transpose() + q * q.transpose() + r * r.transpose() + sum * sum.transpose());
  for (const Vec3d corner : corners) sums.box.include(corner);
  sums.kept += area * shown.kept;
  sums.spread += area * shown.spread;
  sums.colour = sums.colour + Vec3d(shown.colour) * (area * shown.kept);
}

Form form_of(const Sums& sums, const Box& all) {
  const Vec3d size = sums.box.size();
  const double width = std::max(size.x, size.z), whole = scale_of(all);
  const Vec3d whole_size = all.size();
  const double top = sums.box.high.y - all.low.y;
  const bool is_wide = width > std::min(0.35 * std::max(whole_size.x, whole_size.z), 0.6 * whole);
  const bool bears_something = whole_size.y > 0.005 * width;
  if (is_wide && bears_something && size.y < 0.2 * width &&
      top < 0.25 * whole_size.y + 0.02 * whole && sums.level > 0.4 * sums.area) {
    return Form::slab;
  }
  if (!(sums.area > 0)) return Form::flat;
  const Eigen::Vector3d mean = sums.first / sums.area;
  const Eigen::Matrix3d spread = sums.second / sums.area - mean * mean.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(spread, Eigen::EigenvaluesOnly);
  const Eigen::Vector3d extent = axes.eigenvalues().cwiseMax(0).cwiseSqrt();  // ascending
  if (extent[0] < 0.12 * extent[1] || sums.triangles <= 2) return Form::flat;
  if (extent[2] > 2.6 * extent[1]) return Form::tube;
  // A skeleton of branches encloses little of its box; so does a large open sheet.
  const double box = size.x * size.y * size.z;
  const bool is_large = sums.box.longest_side() > 0.3 * whole && sums.triangles > 40;
  if (is_large && std::abs(sums.volume) < 0.06 * box) return Form::tube;
  return Form::lobe;
}

Piece piece_of(const Sums& sums, const Box& all) {
  Piece piece{.area = sums.area,
              .kept = sums.kept,
              .spread = sums.spread,
              .colour = sums.colour,
              .middle = (sums.box.low + sums.box.high) / 2,
              .length = sums.box.longest_side(),
              .triangles = sums.triangles,
              .form = form_of(sums, all)};
  if (sums.kept > 0) piece.colour = piece.colour / sums.kept;
  if (sums.area > 0) {
    piece.kept /= sums.area;
    piece.spread /= sums.area;
  }
  return piece;
}

std::vector<Shown> shown_by(const TreeModel& tree, const Primitive& primitive) {
  const SurfaceColour colour(tree, primitive, kSamples);
  const std::size_t count = primitive.triangles.size();
  std::vector<Shown> shown(colour.varies() ? count : std::min<std::size_t>(count, 1));
  tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t t) { shown[t] = colour.of(t); });
  return shown;
}

}  // namespace

double scale_of(const Box& all) {
  return std::max(all.high.y - all.low.y, 0.15 * all.longest_side());
}

Surface survey(const TreeModel& tree, const Primitive& primitive, const Transform& to_world,
               const Box& all) {
  Surface surface;
  surface.shown = shown_by(tree, primitive);
  surface.welded = weld_positions(primitive);
  surface.piece_of = label_pieces(primitive, surface.welded);
  surface.areas.resize(primitive.triangles.size());
  std::vector<std::uint32_t> numbers(primitive.triangles.size());
  std::iota(numbers.begin(), numbers.end(), 0u);
  const Grouped<std::uint32_t> triangles(numbers, surface.piece_of);
  surface.pieces.resize(triangles.size());
  tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t i) {
    Sums sums;
    for (const std::uint32_t t : triangles[i]) {
      std::array<Vec3d, 3> corners;
      std::ranges::transform(primitive.triangles[t], corners.begin(), [&](std::uint32_t vertex) {
        return transformed(to_world, Vec3d(primitive.positions[vertex]));
      });
      const auto& [a, b, c] = corners;
      surface.areas[t] = length(cross(b - a, c - a)) / 2;
      add(corners, surface.areas[t], surface.shown_at(t), sums);
    }
    surface.pieces[i] = piece_of(sums, all);
  });
  return surface;
}

}  // namespace leafhull
