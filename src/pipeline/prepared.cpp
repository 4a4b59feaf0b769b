// SPDX-License-Identifier: Apache-2.0
#include "pipeline/prepared.h"

namespace leafhull {

std::vector<Vec3d> local(std::span<const Vec3d> places, const Lattice& lattice) {
  std::vector<Vec3d> points;
  points.reserve(places.size());
  for (const Vec3d& place : places) points.push_back(lattice.local(place));
  return points;
}

}  // namespace leafhull
