// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "density/kernel_set.h"

namespace leafhull {

/// An axis-aligned box, in voxels from an origin nearby.
struct LocalBox {
  Vec3f low, high;
};

/// The kernels near a place in groups of eight neighbours, transposed, so that a box is tested
/// against eight at once: first the groups, then the kernels of those that are near.
class NearKernels {
 public:
  NearKernels();
  ~NearKernels();

  /// Takes from `set` the kernels whose support may reach `box`, and some beyond. Boxes are counted
  /// from `origin` until the next load.
  void load(const KernelSet& set, Coord origin, const LocalBox& box);

  /// Appends the ranks of the kernels whose support may reach `box`, rounding included, ascending.
  /// With d from a kernel's centre to that of the box, m_r = |U_r d| and
  /// e_r = |U_r| . (high - low) / 2 for each row r of U: sum max(0, m_r - e_r)^2 <= xi over the
  /// box. SPEC: 5, with the rows of U for the axes.
  void append_reaching(const LocalBox& box, std::vector<std::uint32_t>& ranks);

 private:
  struct alignas(32) Group;
  struct alignas(32) Boxes;

  void set_box(std::size_t group, const LocalBox& box);

  std::vector<std::uint32_t> gathered_;
  std::vector<Group> groups_;
  std::vector<Boxes> boxes_;
  std::size_t count_ = 0;  // of groups
  std::vector<std::uint32_t> near_;
  float reach_ = 0, slack_ = 0;  // voxels
};

}  // namespace leafhull
