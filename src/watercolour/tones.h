// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "render/buffers.h"

namespace leafhull::watercolour {

/// Weights of each pixel, 0..1.
struct Weights {
  std::vector<float> seen;                ///< whether it shows foliage
  std::vector<std::vector<float>> other;  ///< by tone after the first, the share that has it
  std::vector<float> others;              ///< the sum of these
};

/// How much of each of the leaves' tones a pixel of foliage has, by hue and chroma; a colour
/// between two tones has some of both.
/// @param tones the leaves' colours, linear; at least two.
Weights weigh_tones(const render::Buffers& buffers, std::span<const Vec3f> tones);

}  // namespace leafhull::watercolour
