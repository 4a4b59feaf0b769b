// SPDX-License-Identifier: Apache-2.0
#include "surface/extent.h"

#include "density/field_grid.h"

namespace leafhull {

std::vector<Vec3d> extent_of(const Field& field) {
  const auto to_local = [](const openvdb::Coord& c) { return to_vec3d({c.x(), c.y(), c.z()}); };
  std::vector<Vec3d> points;
  for (const Brick* brick : bricks_of(field)) {
    Box box;
    const float* const negated = brick->buffer().data();
    for (openvdb::Index i = 0; i < Brick::SIZE; ++i) {
      if (negated[i] < field.iso_value()) box.include(to_local(brick->offsetToGlobalCoord(i)));
    }
    if (box.empty()) continue;
    for (const double x : {box.low.x, box.high.x}) {
      for (const double y : {box.low.y, box.high.y}) {
        for (const double z : {box.low.z, box.high.z}) {
          points.push_back(field.lattice().world({x, y, z}));
        }
      }
    }
  }
  return points;
}

}  // namespace leafhull
