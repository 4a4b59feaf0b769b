// SPDX-License-Identifier: Apache-2.0
#include "density/kernel_set.h"

#include <openvdb/openvdb.h>
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
  openvdb::MaskTree reached;  // a voxel stands for a root block
  openvdb::tree::ValueAccessor<openvdb::MaskTree> accessor(reached);
  const double r = reach_ + margin;
  const Vec3d grow(r, r, r);
  openvdb::CoordBBox previous;
  for (const Box& cell : hash_->occupied()) {
    const auto root = [&](Vec3d p) {
      const Coord c = cell_of(lattice_.local(p));
      return openvdb::Coord::floor(openvdb::Vec3d(c.x, c.y, c.z) / kRootEdge);
    };
    const Vec3d half = grow * lattice_.voxel_size;
    const openvdb::CoordBBox roots(root(cell.low - half), root(cell.high + half));
    if (roots == previous) continue;
    previous = roots;
    for (auto c = roots.begin(); c; ++c) accessor.setValueOn(*c);
  }
  std::vector<Coord> blocks;
  for (auto c = reached.cbeginValueOn(); c; ++c) {
    const openvdb::Coord o = c.getCoord();
    blocks.push_back({o.x() * kRootEdge, o.y() * kRootEdge, o.z() * kRootEdge});
  }
  std::sort(blocks.begin(), blocks.end());
  return blocks;
}

}  // namespace leafhull
