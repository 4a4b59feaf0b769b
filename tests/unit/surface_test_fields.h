// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "density/field.h"

namespace leafhull {

/// Evaluates one brick of a function of local coordinates.
inline void add_brick(Field& field, const std::function<double(Vec3d)>& density, Coord origin) {
  std::vector<float> samples;
  for (int s = 0; s < kBrickSamples; ++s) {
    const Coord at = origin + Coord{s >> 6, s >> 3 & 7, s & 7};
    samples.push_back(static_cast<float>(density(to_vec3d(at))));
  }
  field.add_bricks({&origin, 1}, samples);
}

/// The field of a function of local coordinates, every brick of [low, high) evaluated.
inline Field field_of(const std::function<double(Vec3d)>& density, double threshold, Coord low,
                      Coord high) {
  Field field({}, threshold);
  for (int x = low.x; x < high.x; x += kBrickEdge) {
    for (int y = low.y; y < high.y; y += kBrickEdge) {
      for (int z = low.z; z < high.z; z += kBrickEdge) {
        add_brick(field, density, {x, y, z});
      }
    }
  }
  return field;
}

}  // namespace leafhull
