// SPDX-License-Identifier: Apache-2.0
#include "density/octants.h"

#include <cmath>

#include "density/falloff.h"
#include "density/simd.h"

namespace leafhull {
namespace {

/// A bound on the rounding of a sum of non-negative terms, as a share of it whatever their weights.
double rounding(std::size_t terms) { return 1e-5 + 1.2e-7 * static_cast<double>(terms); }

struct Outcome {
  std::uint32_t* lists[8];
  std::uint32_t sizes[8] = {};
  float low[8], high[8];
};

FOR_EVERY_VECTOR_WIDTH
void test(std::span<const LatticeKernel> kernels, std::span<const std::uint32_t> ranks,
          const Octants& octants, float half, int falloff, Outcome& outcome) {
  const auto power = [falloff](Floats w) { return falloff_power(w, falloff); };
  const Floats qx = octants.centre.x + octants.apart * Floats{-1, -1, -1, -1, 1, 1, 1, 1};
  const Floats qy = octants.centre.y + octants.apart * Floats{-1, -1, 1, 1, -1, -1, 1, 1};
  const Floats qz = octants.centre.z + octants.apart * Floats{-1, 1, -1, 1, -1, 1, -1, 1};
  Floats low{}, high{};
  for (const std::uint32_t rank : ranks) {
    const LatticeKernel& k = kernels[rank];
    const Floats dx = qx - (static_cast<float>(k.cell.x - octants.origin.x) + k.offset.x);
    const Floats dy = qy - (static_cast<float>(k.cell.y - octants.origin.y) + k.offset.y);
    const Floats dz = qz - (static_cast<float>(k.cell.z - octants.origin.z) + k.offset.z);
    const Floats mx = absolute(k.xx * dx + k.xy * dy + k.xz * dz);
    const Floats my = absolute(k.yy * dy + k.yz * dz);
    const Floats mz = absolute(k.zz * dz);
    const float ex = half * (k.xx + std::fabs(k.xy) + std::fabs(k.xz));
    const float ey = half * (k.yy + std::fabs(k.yz));
    const float ez = half * k.zz;
    const Floats near_x = positive(mx - ex), near_y = positive(my - ey), near_z = positive(mz - ez);
    const Floats far_x = mx + ex, far_y = my + ey, far_z = mz + ez;
    const Floats nearest = near_x * near_x + near_y * near_y + near_z * near_z;
    const Floats farthest = far_x * far_x + far_y * far_y + far_z * far_z;
    low += power(positive(k.top - farthest - kXiSlack * (k.top + farthest)));
    high += power(positive(k.top - nearest + kXiSlack * (k.top + nearest)));
    const Ints reaches = nearest < k.top * (1.0f + kXiSlack);  // -1 where true
    for (int octant = 0; octant < 8; ++octant) {
      const std::uint32_t size = outcome.sizes[octant];
      outcome.lists[octant][size] = rank;
      outcome.sizes[octant] = size - static_cast<std::uint32_t>(reaches[octant]);
    }
  }
  for (int octant = 0; octant < 8; ++octant) {
    outcome.low[octant] = low[octant];
    outcome.high[octant] = high[octant];
  }
}

}  // namespace

void OctantLists::narrow(std::span<const LatticeKernel> kernels,
                         std::span<const std::uint32_t> ranks, const Octants& octants, double reach,
                         int falloff) {
  Outcome outcome;
  for (int octant = 0; octant < 8; ++octant) {
    // One more than needed: a rank is written before it is known whether it counts.
    if (lists_[octant].size() <= ranks.size()) lists_[octant].resize(2 * ranks.size() + 1);
    outcome.lists[octant] = lists_[octant].data();
  }
  const float half = octants.half * (1 + kPositionSlack) +
                     kDistanceSlack * (static_cast<float>(reach) + kRootEdge);
  test(kernels, ranks, octants, half, falloff, outcome);
  for (int octant = 0; octant < 8; ++octant) {
    sizes_[octant] = outcome.sizes[octant];
    low_[octant] = static_cast<double>(outcome.low[octant]) * (1 - rounding(sizes_[octant]));
    high_[octant] = static_cast<double>(outcome.high[octant]) * (1 + rounding(sizes_[octant]));
  }
}

}  // namespace leafhull
