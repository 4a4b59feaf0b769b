// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "density/local_kernel.h"

namespace leafhull {

/// Eight cubes around a point: octant i has its centre at `centre` plus `apart` along each axis
/// where the bit of i is set (4 x, 2 y, 1 z) and minus it where not. Voxels, from `origin`.
struct Octants {
  Coord origin;
  Vec3f centre;
  float apart;
  float half;  ///< half the edge of each cube
};

/// The kernels whose support may reach each of eight octants, and bounds on N over each.
class OctantLists {
 public:
  /// Takes the kernels from `ranks`, keeping their order. With d from a kernel's centre to that of
  /// an octant, m_r = |U_r d| and e_r = half * sum |U_r| for each row r of U,
  ///   sum max(0, m_r - e_r)^2 <= h xi <= sum (m_r + e_r)^2
  /// over the octant; rounding is allowed for. `reach`: voxels. SPEC: 5, with the rows of U for
  /// the axes.
  void narrow(std::span<const LatticeKernel> kernels, std::span<const std::uint32_t> ranks,
              const Octants& octants, double reach, int falloff);

  std::span<const std::uint32_t> list(int octant) const {
    return std::span(lists_[octant]).first(sizes_[octant]);
  }
  /// Bounds on N over an octant, valid for any order of summing in floats.
  double low(int octant) const { return low_[octant]; }
  double high(int octant) const { return high_[octant]; }

 private:
  std::array<std::vector<std::uint32_t>, 8> lists_;
  std::array<std::uint32_t, 8> sizes_{};
  std::array<double, 8> low_{}, high_{};
};

}  // namespace leafhull
