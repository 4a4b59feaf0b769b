// SPDX-License-Identifier: Apache-2.0
#include "pipeline/evaluate.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <memory>

namespace leafhull {
namespace {

Coord corner(Coord cell, int i) { return cell + Coord{i >> 2 & 1, i >> 1 & 1, i & 1}; }

}  // namespace

std::vector<float> DensityFunction::at(std::span<const Vec3d> points) {
  std::vector<float> density(points.size(), 0.0f);
  find_kernels_near(kernels_, points, falloff_, [&](const PointBatch& batch) {
    const std::vector<float> values = evaluator_.density(batch);
    for (std::size_t i = 0; i < values.size(); ++i) density[batch.index[i]] = values[i];
  });
  return density;
}

std::vector<float> DensityFunction::interpolated_at(std::span<const Vec3d> points) {
  std::vector<Coord> samples;
  for (const Vec3d p : points) {
    for (int i = 0; i < 8; ++i) samples.push_back(corner(cell_of(p), i));
  }
  tbb::parallel_sort(samples);
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  std::vector<Vec3d> positions;
  positions.reserve(samples.size());
  for (const Coord s : samples) positions.push_back(to_vec3d(s));
  const std::vector<float> values = at(positions);

  std::vector<float> density;
  density.reserve(points.size());
  for (const Vec3d p : points) {
    const Coord cell = cell_of(p);
    const Vec3d f = p - to_vec3d(cell);
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
      const Coord c = corner(cell, i);
      const auto found = std::lower_bound(samples.begin(), samples.end(), c) - samples.begin();
      sum += (i >> 2 & 1 ? f.x : 1 - f.x) * (i >> 1 & 1 ? f.y : 1 - f.y) * (i & 1 ? f.z : 1 - f.z) *
             static_cast<double>(values[static_cast<std::size_t>(found)]);
    }
    density.push_back(static_cast<float>(sum));
  }
  return density;
}

DensityFunction::Sampled DensityFunction::sample_band(double threshold, int margin, bool dense,
                                                      const std::function<void(double)>& advance) {
  BandOptions options{.falloff = falloff_, .margin = margin};
  if (!dense) options.lowest = options.highest = threshold;
  Sampled result{Field(kernels_.lattice(), threshold)};
  Field& field = result.field;
  const auto inside = find_band(kernels_, options, [&](const BrickList& bricks, double done) {
    const std::size_t size = bricks.size() * kBrickSamples;
    const auto samples = std::make_unique_for_overwrite<float[]>(size);
    result.pairs += evaluator_.sample(bricks, {samples.get(), size});
    field.add_bricks(bricks.origins, {samples.get(), size});
    advance(done);
  });
  field.add_inside(inside);
  return result;
}

std::vector<Vec3f> DensityFunction::snap(std::span<Vec3f> points, double threshold, int steps) {
  std::vector<Vec3d> positions(points.size());
  std::transform(points.begin(), points.end(), positions.begin(), [](Vec3f p) { return Vec3d(p); });
  std::vector<Vec3f> normals(points.size());
  find_kernels_near(kernels_, positions, falloff_, [&](const PointBatch& batch) {
    const Evaluator::Snapped snapped = evaluator_.snap(batch, threshold, steps);
    for (std::size_t b = 0; b < batch.bricks.size(); ++b) {
      const Vec3d origin = to_vec3d(batch.bricks.origins[b]);
      for (std::uint32_t i = batch.first_point[b]; i < batch.first_point[b + 1]; ++i) {
        points[batch.index[i]] = Vec3f(origin + Vec3d(snapped.offset[i]));
        normals[batch.index[i]] = snapped.normal[i];
      }
    }
  });
  return normals;
}

}  // namespace leafhull
