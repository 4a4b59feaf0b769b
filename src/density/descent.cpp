// SPDX-License-Identifier: Apache-2.0
#include "density/descent.h"

namespace leafhull {
namespace {

// N is summed in floats, here and on the device. The bounds give way by more than the rounding of a
// position (a share of the block, as thin kernels magnify it), of xi, and of a sum of many terms.
constexpr float kPositionSlack = 1e-5f;
constexpr float kXiSlack = 1e-4f;

double rounding(std::size_t terms) { return 1e-5 + 1.2e-7 * static_cast<double>(terms); }

}  // namespace

void Descent::load(Coord root) {
  root_ = root;
  const double margin = margin_;
  const Vec3d low = to_vec3d(root) - Vec3d(margin, margin, margin);
  const double edge = kRootEdge - 1 + 2 * margin;
  hash_.gather(low, low + Vec3d(edge, edge, edge), kernels_[0]);
  near_.clear();
  position_[0].clear();
  for (const std::uint32_t k : kernels_[0]) {
    const LatticeKernel kernel = to_lattice(hash_.kernels()[k], hash_.lattice());
    const Vec3f cell(static_cast<float>(kernel.cell.x - root.x),
                     static_cast<float>(kernel.cell.y - root.y),
                     static_cast<float>(kernel.cell.z - root.z));
    position_[0].push_back(static_cast<std::uint32_t>(near_.size()));
    near_.push_back({kernel.axes, cell + kernel.offset});
  }
}

Descent::Bounds Descent::narrow(const Block& block, int level) {
  const std::vector<std::uint32_t>& from = position_[level];
  std::vector<std::uint32_t>& to = position_[level + 1];
  std::vector<std::uint32_t>& kernels = kernels_[level + 1];
  to.clear();
  kernels.clear();

  const float half = (0.5f * static_cast<float>(block.edge - 1) + static_cast<float>(margin_)) *
                     (1 + kPositionSlack);
  const auto centre = [&](int origin, int root) {
    return static_cast<float>(origin - root) + 0.5f * static_cast<float>(block.edge - 1);
  };
  const Vec3f q(centre(block.origin.x, root_.x), centre(block.origin.y, root_.y),
                centre(block.origin.z, root_.z));
  Bounds sum;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Near& kernel = near_[from[i]];
    const Interval xi = xi_bounds(kernel.axes, q - kernel.centre, half);
    if (xi.low >= 1 + kXiSlack) continue;
    to.push_back(from[i]);
    kernels.push_back(kernels_[level][i]);
    sum.low += falloff_of(xi.high + kXiSlack * (1 + xi.high), falloff_);
    sum.high += falloff_of(xi.low - kXiSlack * (1 + xi.low), falloff_);
  }
  sum.low *= 1 - rounding(to.size());
  sum.high *= 1 + rounding(to.size());
  return sum;
}

}  // namespace leafhull
