// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "density/bounds.h"
#include "density/kernel_hash.h"
#include "leafhull/error.h"

namespace leafhull {

/// The bricks of a batch and, brick by brick, the kernels that may reach it, ascending:
/// kernels[first[b]] to kernels[first[b + 1]].
struct BrickList {
  std::vector<Coord> origins;
  std::vector<std::uint32_t> first{0};
  std::vector<std::uint32_t> kernels;

  std::size_t size() const { return origins.size(); }
  /// @throws Error usage where the lists outgrow 32 bits.
  void add(Coord origin, std::span<const std::uint32_t> near) {
    if (kernels.size() + near.size() > std::numeric_limits<std::uint32_t>::max()) {
      throw Error(ErrorCode::usage, "too many kernels reach one place",
                  "Lower --radius-max or --leaf-scale.");
    }
    origins.push_back(origin);
    kernels.insert(kernels.end(), near.begin(), near.end());
    first.push_back(static_cast<std::uint32_t>(kernels.size()));
  }
  void append(const BrickList& other) {
    const std::uint32_t offset = first.back();
    origins.insert(origins.end(), other.origins.begin(), other.origins.end());
    kernels.insert(kernels.end(), other.kernels.begin(), other.kernels.end());
    for (std::size_t b = 1; b < other.first.size(); ++b) first.push_back(offset + other.first[b]);
  }
};

/// The way down from a root block to bricks: at each block the parent's kernels are narrowed to
/// those that may reach it, so a brick's list does not depend on who asks for it.
class Descent {
 public:
  /// `margin`: voxels by which every block is grown before it is tested.
  Descent(const KernelHash& hash, int falloff, int margin)
      : hash_(hash), falloff_(falloff), margin_(margin) {}

  /// Bounds on N over a grown block, rounding included.
  struct Bounds {
    double low = 0, high = 0;
  };

  /// Calls enter(block), then visit(block, kernels, bounds), and goes on to the eight children of a
  /// block above brick size where both answer true. Children come in lexicographic order.
  template <class Enter, class Visit>
  void from(Coord root, Enter&& enter, Visit&& visit) {
    const Block block{root, kRootEdge};
    if (!enter(block)) return;
    load(root);
    descend(block, 0, enter, visit);
  }

 private:
  static constexpr int kLevels = 3;  // edges 32, 16, 8
  static_assert(kRootEdge == kBrickEdge << (kLevels - 1));

  /// A kernel relative to the root's origin.
  struct Near {
    std::array<Vec3f, 3> axes;
    Vec3f centre;
  };

  void load(Coord root);
  Bounds narrow(const Block& block, int level);

  template <class Enter, class Visit>
  void descend(const Block& block, int level, Enter& enter, Visit& visit) {
    const Bounds bounds = narrow(block, level);
    if (!visit(block, std::span<const std::uint32_t>(kernels_[level + 1]), bounds)) return;
    if (block.edge == kBrickEdge) return;
    const int half = block.edge / 2;
    for (int child = 0; child < 8; ++child) {
      const Block part{block.origin + Coord{(child >> 2 & 1) * half, (child >> 1 & 1) * half,
                                            (child & 1) * half},
                       half};
      if (enter(part)) descend(part, level + 1, enter, visit);
    }
  }

  const KernelHash& hash_;
  int falloff_;
  int margin_;
  Coord root_{};
  std::vector<Near> near_;                                        // the root's kernels
  std::array<std::vector<std::uint32_t>, kLevels + 1> position_;  // into near_, by level
  std::array<std::vector<std::uint32_t>, kLevels + 1> kernels_;   // the same, into the kernel set
};

}  // namespace leafhull
