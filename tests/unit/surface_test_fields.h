// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>

#include "density/field.h"

namespace leafhull {

/// The field of a function of local coordinates, every brick of [low, high) evaluated.
inline Field field_of(const std::function<double(Vec3d)>& density, double threshold, Coord low,
                      Coord high) {
  Field field;
  field.threshold = threshold;
  for (int x = low.x; x < high.x; x += kBrickEdge) {
    for (int y = low.y; y < high.y; y += kBrickEdge) {
      for (int z = low.z; z < high.z; z += kBrickEdge) {
        field.origins.push_back({x, y, z});
        for (int s = 0; s < kBrickSamples; ++s) {
          const Coord at = Coord{x, y, z} + Coord{s >> 6, s >> 3 & 7, s & 7};
          field.samples.push_back(static_cast<float>(density(to_vec3d(at))));
        }
      }
    }
  }
  return field;
}

}  // namespace leafhull
