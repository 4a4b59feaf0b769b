// SPDX-License-Identifier: Apache-2.0
#include "density/kernel_set.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace leafhull {
namespace {

float largest_radius(const Kernel& k) {
  return std::max({k.radius_major, k.radius_minor, k.radius_normal});
}

float largest_radius(std::span<const Kernel> kernels) {
  float largest = 0;
  for (const Kernel& k : kernels) largest = std::max(largest, largest_radius(k));
  return largest;
}

}  // namespace

KernelSet::KernelSet(std::span<const Kernel> kernels, std::shared_ptr<const SpatialHash> hash,
                     const Lattice& lattice, int falloff)
    : hash_(std::move(hash)),
      lattice_(lattice),
      kernels_(kernels.size()),
      radii_(kernels.size()),
      reach_(static_cast<double>(largest_radius(kernels)) / lattice.voxel_size) {
  const std::span<const std::uint32_t> order = hash_->order();
  tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t rank) {
    const Kernel& kernel = kernels[order[rank]];
    kernels_[rank] = to_lattice(kernel, lattice_, falloff);
    radii_[rank] =
        static_cast<float>(static_cast<double>(largest_radius(kernel)) / lattice_.voxel_size);
  });
}

KernelSet::KernelSet(std::vector<LatticeKernel> kernels, std::shared_ptr<const SpatialHash> hash,
                     const Lattice& lattice, double reach)
    : hash_(std::move(hash)), lattice_(lattice), kernels_(std::move(kernels)), reach_(reach) {}

void KernelSet::gather(Vec3d low, Vec3d high, std::vector<std::uint32_t>& ranks) const {
  constexpr double kRounding = 1e-3;
  const double r = reach_ * (1 + kRounding) + kRounding;
  const Vec3d grow(r, r, r);
  hash_->gather(lattice_.world(low - grow), lattice_.world(high + grow), ranks);
}

std::vector<Coord> KernelSet::root_blocks(double margin) const {
  const double r = (reach_ + margin) * lattice_.voxel_size;
  const Vec3d grow(r, r, r);
  const auto root = [&](Vec3d p) { return block_origin(cell_of(lattice_.local(p)), kRootEdge); };
  std::vector<Coord> blocks;
  std::pair<Coord, Coord> previous{{1, 1, 1}, {}};  // no root block
  for (const Box& cell : hash_->occupied()) {
    const std::pair reached{root(cell.low - grow), root(cell.high + grow)};
    if (reached == previous) continue;
    previous = reached;
    const auto& [low, high] = reached;
    for (int x = low.x; x <= high.x; x += kRootEdge) {
      for (int y = low.y; y <= high.y; y += kRootEdge) {
        for (int z = low.z; z <= high.z; z += kRootEdge) blocks.push_back({x, y, z});
      }
    }
  }
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  return blocks;
}

}  // namespace leafhull
