// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "density/kernel_set.h"

namespace leafhull {

/// An axis-aligned box, in voxels from an origin nearby.
struct LocalBox {
  Vec3f low, high;
};

/// Kernels in groups of eight that follow each other in rank, transposed, so that a box is tested
/// against eight at once.
class KernelGroups {
 public:
  explicit KernelGroups(std::span<const LatticeKernel> kernels);
  ~KernelGroups();

 private:
  friend class NearKernels;
  struct Group;
  std::unique_ptr<Group[]> groups_;
};

/// Finds the kernels near a place: first the groups that are near, then kernels in these groups.
class NearKernels {
 public:
  /// `groups` holds the kernels of `set`.
  NearKernels(const KernelSet& set, const KernelGroups& groups);
  ~NearKernels();
  NearKernels(NearKernels&&) noexcept;

  /// Takes the kernels whose support may reach `box`, and some beyond. Boxes are counted from
  /// `origin` until the next load.
  void load(Coord origin, const LocalBox& box);

  /// Appends the ranks of the kernels whose support may reach `box`, rounding included, ascending.
  /// With d from a kernel's centre to that of the box, m_r = |U_r d| and
  /// e_r = |U_r| . (high - low) / 2 for each row r of U: sum max(0, m_r - e_r)^2 <= h xi over the
  /// box. SPEC: 5, with the rows of U for the axes.
  void append_reaching(const LocalBox& box, std::vector<std::uint32_t>& ranks);

 private:
  struct Centres;
  struct Boxes;

  const KernelSet& set_;
  const KernelGroups& groups_;
  std::vector<std::uint32_t> gathered_;  // groups
  std::vector<Centres> centres_;         // of each
  std::vector<Boxes> boxes_;             // around them
  std::vector<std::uint32_t> near_;
  float reach_ = 0, slack_ = 0;  // voxels
};

}  // namespace leafhull
