// SPDX-License-Identifier: Apache-2.0
#include "pipeline/evaluate.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>

namespace leafhull {
namespace {

/// The most ranks that DensityFunction::Lists::keep_few keeps.
constexpr std::size_t kFewRanks = std::size_t{1} << 24;

/// An offset as it is added to its frame's origin: unchanged for floats, else rounded to 2^-20.
template <class T>
Vec3d rounded(Vec3f offset) {
  if constexpr (std::is_same_v<T, float>) return Vec3d(offset);  // the sum is rounded
  const auto r = [](float v) { return std::round(static_cast<double>(v) * 0x1p20); };
  return Vec3d(r(offset.x), r(offset.y), r(offset.z)) * 0x1p-20;
}

/// Visits the lanes of each group; lanes that fill up a chunk repeat one of its points.
template <class Visit>
void for_each_lane(const PointBatch& batch, Visit&& visit) {
  tbb::parallel_for(std::size_t{0}, batch.groups.size(), [&](std::size_t g) {
    const PointGroup& group = batch.groups[g];
    const std::size_t first = group.chunk * batch.chunk_points;
    for (std::size_t lane = first; lane < first + group.count * batch.chunk_points; ++lane) {
      visit(lane, group.origin);
    }
  });
}

}  // namespace

std::vector<float> DensityFunction::at(std::span<const Vec3d> points) {
  std::vector<float> density(points.size(), 0.0f);
  const PointSearch how{Within::point, evaluator_.chunk_points()};
  find_kernels_near(kernels_, points, how, [&](PointBatch& batch) {
    const std::vector<float> values = evaluator_.density(batch);
    for_each_lane(batch,
                  [&](std::size_t lane, Coord) { density[batch.index[lane]] = values[lane]; });
  });
  return density;
}

std::vector<float> DensityFunction::interpolated_at(std::span<const Vec3d> points) {
  std::vector<Coord> samples(8 * points.size());
  tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
    samples[i] = corner(cell_of(points[i / 8]), static_cast<int>(i % 8));
  });
  tbb::parallel_sort(samples);
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  std::vector<Vec3d> positions(samples.size());
  std::transform(samples.begin(), samples.end(), positions.begin(), to_vec3d);
  const std::vector<float> values = at(positions);

  std::vector<float> density(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t point) {
    const Coord cell = cell_of(points[point]);
    const auto value = [&](int i) {
      const auto found = std::ranges::lower_bound(samples, corner(cell, i)) - samples.begin();
      return values[static_cast<std::size_t>(found)];
    };
    density[point] = static_cast<float>(trilinear(points[point] - to_vec3d(cell), value));
  });
  return density;
}

DensityFunction::Sampled DensityFunction::sample_band(std::vector<double> thresholds, int margin,
                                                      bool dense, Lists lists,
                                                      const std::function<void(double)>& advance) {
  Field field(kernels_.lattice(), thresholds.front());
  if (dense) thresholds.clear();
  const BandOptions options{
      .thresholds = std::move(thresholds), .falloff = falloff_, .margin = margin};
  return sample(options, std::move(field), lists, advance);
}

DensityFunction::Sampled DensityFunction::sample_band(double threshold, const SampleBox& range) {
  const BandOptions options{.thresholds = {threshold}, .falloff = falloff_, .range = range};
  return sample(options, Field(kernels_.lattice(), threshold), Lists::forget, [](double) {});
}

DensityFunction::Sampled DensityFunction::sample(const BandOptions& options, Field empty,
                                                 Lists lists,
                                                 const std::function<void(double)>& advance) {
  Sampled result;
  result.field = std::move(empty);
  Field& field = result.field;
  lists_.reset();
  if (lists != Lists::forget) lists_.emplace();
  const auto inside = find_band(kernels_, options, [&](const BrickList& bricks, double done) {
    const std::size_t size = bricks.size() * kBrickSamples;
    const auto samples = std::make_unique_for_overwrite<float[]>(size);
    result.pairs += evaluator_.sample(bricks, {samples.get(), size});
    field.add_bricks(bricks.origins, {samples.get(), size});
    if (lists_ && lists == Lists::keep_few &&
        lists_->kernels.size() + bricks.kernels.size() > kFewRanks) {
      lists_.reset();
    }
    if (lists_) lists_->append(bricks);
    advance(done);
  });
  field.add_inside(inside);
  return result;
}

template <class T>
std::vector<Vec3f> DensityFunction::snap_points(std::span<Vec3<T>> points, double threshold,
                                                int steps) {
  std::vector<Vec3f> normals(points.size());
  const auto put = [&](PointBatch& batch) {
    const Evaluator::Normals normal = evaluator_.snap(batch, threshold, steps);
    for_each_lane(batch, [&](std::size_t lane, Coord origin) {
      const std::uint32_t point = batch.index[lane];
      const Vec3f offset(batch.x[lane], batch.y[lane], batch.z[lane]);
      points[point] = Vec3<T>(to_vec3d(origin) + rounded<T>(offset));
      normals[point] = {normal.x[lane], normal.y[lane], normal.z[lane]};
    });
  };
  find_kernels_near(kernels_, std::span<const Vec3<T>>(points),
                    {Within::cell, evaluator_.chunk_points(), lists()}, put);
  return normals;
}

std::vector<Vec3f> DensityFunction::snap(std::span<Vec3f> points, double threshold, int steps) {
  return snap_points(points, threshold, steps);
}

std::vector<Vec3f> DensityFunction::snap(std::span<Vec3d> points, double threshold, int steps) {
  return snap_points(points, threshold, steps);
}

}  // namespace leafhull
