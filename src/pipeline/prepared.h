// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "density/spatial_hash.h"
#include "leafhull/shape.h"
#include "pipeline/stage_options.h"
#include "points/leaf_points.h"

namespace leafhull {

/// A tree's kernels and T, the results of steps 1 to 5 of Figure 8.
struct Prepared {
  Options options;  ///< resolved
  Grid grid{};
  FieldOptions field{};  ///< the options of its stages, and those for sampling
  std::shared_ptr<LeafPoints> points{};
  std::shared_ptr<const SpatialHash> hash{};  ///< of the leaf points
  std::shared_ptr<std::vector<float>>
      isotropic_density{};                         ///< N_iso, one per leaf point, if asked for
  DensityStatistics statistics{};                  ///< of N_iso
  std::shared_ptr<std::vector<Kernel>> kernels{};  ///< one per leaf point
  std::shared_ptr<std::vector<float>> there{};     ///< N at the places on the leaves, if asked for
  double threshold = 0;                            ///< T
};

/// The value that `shared` holds, moved instead of copied if there is no other owner.
template <class Value>
Value taken(std::shared_ptr<Value> shared) {
  if (shared.use_count() == 1) return std::move(*shared);
  return *shared;
}

/// Places in voxels from a lattice's anchor.
inline std::vector<Vec3d> local(std::span<const Vec3d> places, const Lattice& lattice) {
  std::vector<Vec3d> points;
  points.reserve(places.size());
  for (const Vec3d& place : places) points.push_back(lattice.local(place));
  return points;
}

/// The centres of points, kernels or leaf vertices, model units.
template <class Point>
std::vector<Vec3d> positions_of(const std::vector<Point>& points) {
  std::vector<Vec3d> positions;
  positions.reserve(points.size());
  for (const Point& point : points) positions.push_back(point.position);
  return positions;
}

}  // namespace leafhull
