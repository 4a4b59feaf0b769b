// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "leafhull/vec.h"

namespace leafhull::render {

/// What a pixel shows.
enum class Object : std::uint8_t { paper, foliage, wood };

/// What one extra ray of a pixel at an edge sees; values are as in Buffers.
struct EdgeSample {
  Object object = Object::paper;
  float depth = HUGE_VALF;
  Vec3f normal, position, color;
  float key = 1, open = 1;
};

/// What every pixel of a picture sees, rows from the top, width * height values each. Lengths are
/// in scene units (the scene is about 1 large); directions are along the model's axes.
struct Buffers {
  int width = 0, height = 0;
  std::vector<Object> object;        ///< the nearest object at the pixel's centre
  std::vector<float> foliage, wood;  ///< how much of the pixel each covers, 0..1
  std::vector<float> depth;          ///< along the camera's axis; infinite on paper
  std::vector<Vec3f> normal;         ///< unit, on the eye's side; zero on paper
  std::vector<Vec3f> position;       ///< in the scene
  std::vector<Vec3f> color;          ///< of the surface, linear
  std::vector<float> key;            ///< share of the key light that arrives, 0 in shadow to 1
  std::vector<float> open;  ///< share of the sky's light, 0..1: ambient occlusion is 1 - open
  std::vector<std::uint32_t> edges;  ///< the pixels where surfaces end, each once
  int edge_rays = 0;                 ///< rays per edge pixel besides the one through its centre
  std::vector<EdgeSample> samples;   ///< edge_rays for each edge, in the order of `edges`
  Vec3f eye;                         ///< of the camera, in the scene
  Vec3f to_light;                    ///< unit, towards the key light
  Vec3f to_eye;                      ///< unit, against the camera's axis

  std::size_t size() const { return object.size(); }
  /// Sets the size and fills all with paper.
  void resize(int new_width, int new_height);
};

}  // namespace leafhull::render
