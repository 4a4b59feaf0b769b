// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "density/kernel_set.h"
#include "density/octants.h"
#include "leafhull/error.h"

namespace leafhull {

/// The bricks of a batch and, brick by brick, the ranks of the kernels that may reach it,
/// ascending: kernels[first[b]] to kernels[first[b + 1]].
struct BrickList {
  std::vector<Coord> origins;
  std::vector<std::uint32_t> first{0};
  std::vector<std::uint32_t> kernels;

  std::size_t size() const { return origins.size(); }
  std::span<const std::uint32_t> list(std::size_t brick) const {
    return std::span(kernels).subspan(first[brick], first[brick + 1] - first[brick]);
  }
  /// @throws Error usage where the lists outgrow 32 bits, as append does.
  void add(Coord origin, std::span<const std::uint32_t> near) {
    make_room(near.size());
    origins.push_back(origin);
    kernels.insert(kernels.end(), near.begin(), near.end());
    first.push_back(static_cast<std::uint32_t>(kernels.size()));
  }
  void append(const BrickList& other) {
    make_room(other.kernels.size());
    const std::uint32_t offset = first.back();
    origins.insert(origins.end(), other.origins.begin(), other.origins.end());
    kernels.insert(kernels.end(), other.kernels.begin(), other.kernels.end());
    for (std::size_t b = 1; b < other.first.size(); ++b) first.push_back(offset + other.first[b]);
  }

 private:
  void make_room(std::size_t more) const {
    if (kernels.size() + more > std::numeric_limits<std::uint32_t>::max()) {
      throw Error(ErrorCode::usage, "too many kernels reach one place",
                  "Lower --radius-max, --leaf-scale or --resolution.");
    }
  }
};

/// The way down from a root block to bricks: at each block the kernels are narrowed to those that
/// may reach its octants, so a brick's list does not depend on who asks for it.
class Descent {
 public:
  /// `margin`: voxels by which every block is grown before it is tested.
  Descent(const KernelSet& kernels, int falloff, int margin)
      : kernels_(kernels), falloff_(falloff), margin_(static_cast<float>(margin)) {}

  /// Bounds on N over a grown block, rounding included.
  struct Bounds {
    double low = 0, high = 0;
  };

  /// Calls visit(block, ranks, bounds) for the octants of `root` in lexicographic order. Where it
  /// returns true for a block larger than a brick, descends to that block's octants.
  template <class Visit>
  void from(Coord root, Visit&& visit) {
    const Vec3d low = to_vec3d(root) - Vec3d(1, 1, 1) * margin_;
    kernels_.gather(low, low + Vec3d(1, 1, 1) * (kRootEdge - 1 + 2 * margin_), near_root_);
    descend({root, kRootEdge}, near_root_, 0, visit);
  }

 private:
  static constexpr int kLevels = 2;  // octants of edge 16 and 8
  static_assert(kRootEdge == kBrickEdge << kLevels);

  template <class Visit>
  void descend(const Block& block, std::span<const std::uint32_t> ranks, int level, Visit& visit) {
    const int edge = block.edge / 2;
    OctantLists& octants = octants_[level];
    octants.narrow(kernels_.kernels(), ranks, octants_of(block), kernels_.reach(), falloff_);
    for (int i = 0; i < 8; ++i) {
      const Coord corner{(i >> 2 & 1) * edge, (i >> 1 & 1) * edge, (i & 1) * edge};
      const Block octant{block.origin + corner, edge};
      const Bounds bounds{octants.low(i), octants.high(i)};
      if (visit(octant, octants.list(i), bounds) && edge > kBrickEdge) {
        descend(octant, octants.list(i), level + 1, visit);
      }
    }
  }

  /// The samples of the octants, grown by the margin.
  Octants octants_of(const Block& block) const {
    const float edge = 0.5f * static_cast<float>(block.edge);
    const float middle = edge - 0.5f;
    return {block.origin, {middle, middle, middle}, 0.5f * edge, 0.5f * (edge - 1) + margin_};
  }

  const KernelSet& kernels_;
  int falloff_;
  float margin_;
  std::vector<std::uint32_t> near_root_;
  std::array<OctantLists, kLevels> octants_;
};

}  // namespace leafhull
