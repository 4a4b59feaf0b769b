// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <set>
#include <vector>

#include "density/field.h"
#include "density/field_grid.h"

namespace leafhull {

/// The bounds of most fields.
inline constexpr Coord kLow{-16, -16, -16}, kHigh{16, 16, 16};

/// Adds a brick of samples of a function of local coordinates.
inline void add_brick(Field& field, const std::function<double(Vec3d)>& density, Coord origin) {
  std::vector<float> samples;
  for (int s = 0; s < kBrickSamples; ++s) {
    const Coord at = origin + Coord{s >> 6, s >> 3 & 7, s & 7};
    samples.push_back(static_cast<float>(density(to_vec3d(at))));
  }
  field.add_bricks({&origin, 1}, samples);
}

/// The field of a function of local coordinates with every brick of [low, high).
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

inline bool is_inside(const Field& field, Coord at) {
  const openvdb::Coord c(at.x, at.y, at.z);
  return negated_grid(field).tree().getValue(c) < field.iso_value();
}

/// Calls visit with every sample of [low, high).
template <class Visit>
void for_each_sample(Coord low, Coord high, const Visit& visit) {
  for (int x = low.x; x < high.x; ++x) {
    for (int y = low.y; y < high.y; ++y) {
      for (int z = low.z; z < high.z; ++z) visit(Coord{x, y, z});
    }
  }
}

/// The field of a function for ascending thresholds, as the search for the band leaves it: a block
/// that lies on one side of T together with the samples around it is not evaluated.
inline Field band_of(const std::function<double(Vec3d)>& density,
                     const std::vector<double>& thresholds, Coord low, Coord high) {
  Field field({}, thresholds.front());
  for (int x = low.x; x < high.x; x += kBrickEdge) {
    for (int y = low.y; y < high.y; y += kBrickEdge) {
      for (int z = low.z; z < high.z; z += kBrickEdge) {
        std::set<std::ptrdiff_t> reached;
        for_each_sample({x - 1, y - 1, z - 1}, {x + 9, y + 9, z + 9}, [&](Coord at) {
          const auto t =
              std::upper_bound(thresholds.begin(), thresholds.end(), density(to_vec3d(at)));
          reached.insert(t - thresholds.begin());
        });
        if (reached.size() > 1) {
          add_brick(field, density, {x, y, z});
        } else if (const std::ptrdiff_t t = *reached.begin(); t > 0) {
          const double proven = thresholds[static_cast<std::size_t>(t - 1)];
          field.add_inside(std::vector<InsideBlock>{{{{x, y, z}, kBrickEdge}, proven}});
        }
      }
    }
  }
  return field;
}

inline double volume(const Polygons& polygons) {
  double sum = 0;
  for (const auto& [a, b, c] : triangulate(polygons)) {
    sum +=
        dot(Vec3d(polygons.points[a]), cross(Vec3d(polygons.points[b]), Vec3d(polygons.points[c])));
  }
  return sum / 6;
}

}  // namespace leafhull
