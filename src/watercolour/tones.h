// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "render/buffers.h"

namespace leafhull::watercolour {

/// Of each pixel, 0..1.
struct Weights {
  std::vector<float> seen;                ///< whether it shows foliage
  std::vector<std::vector<float>> other;  ///< by tone after the first, how much has it
  std::vector<float> others;              ///< the sum of these
};

/// Which of the leaves' tones each pixel of foliage has: between two of them some of both, by
/// hue and chroma.
/// @param tones linear, as leaves have them; two at least.
Weights weigh_tones(const render::Buffers& buffers, std::span<const Vec3f> tones);

}  // namespace leafhull::watercolour
