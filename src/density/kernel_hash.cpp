// SPDX-License-Identifier: Apache-2.0
#include "density/kernel_hash.h"

#include <openvdb/tools/PointIndexGrid.h>

#include <algorithm>

namespace leafhull {
namespace {

/// Kernel centres as OpenVDB's PointArray, in voxels from the anchor.
struct Centres {
  using PosType = openvdb::Vec3d;

  std::span<const Kernel> kernels;
  const Lattice& lattice;

  std::size_t size() const { return kernels.size(); }
  void getPos(std::size_t n, PosType& position) const {
    const Vec3d p = lattice.local(kernels[n].centre);
    position = {p.x, p.y, p.z};
  }
};

double largest_radius(std::span<const Kernel> kernels) {
  float reach = 0;
  for (const Kernel& k : kernels) {
    reach = std::max({reach, k.radius_major, k.radius_minor, k.radius_normal});
  }
  return reach;
}

}  // namespace

struct KernelHash::Grid {
  openvdb::tools::PointIndexGrid::Ptr index;
};

KernelHash::KernelHash(std::span<const Kernel> kernels, const Lattice& lattice)
    : kernels_(kernels),
      lattice_(lattice),
      reach_(largest_radius(kernels) / lattice.voxel_size),
      cell_(std::max(reach_, static_cast<double>(kBrickEdge))),
      grid_(std::make_unique<Grid>()) {
  const auto transform = openvdb::math::Transform::createLinearTransform(cell_);
  transform->postTranslate(openvdb::Vec3d(cell_ / 2));  // cells start at multiples of their size
  grid_->index = openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(
      Centres{kernels_, lattice_}, *transform);
}

KernelHash::~KernelHash() = default;
KernelHash::KernelHash(KernelHash&&) noexcept = default;

void KernelHash::gather(Vec3d low, Vec3d high, std::vector<std::uint32_t>& found) const {
  const auto cell = [&](Vec3d p, double grow) {
    return openvdb::Coord::floor(openvdb::Vec3d(p.x + grow, p.y + grow, p.z + grow) / cell_);
  };
  auto accessor = grid_->index->getConstAccessor();
  openvdb::tools::PointIndexIterator<> it(
      openvdb::CoordBBox(cell(low, -reach_), cell(high, reach_)), accessor);
  found.clear();
  for (; it; ++it) found.push_back(*it);
  std::sort(found.begin(), found.end());
}

std::vector<Coord> KernelHash::root_blocks(double margin) const {
  std::vector<Coord> roots;
  for (auto cell = grid_->index->cbeginValueOn(); cell; ++cell) {
    const openvdb::Vec3d low = cell.getCoord().asVec3d() * cell_;
    const auto root = [&](const openvdb::Vec3d& p) {
      return block_origin(cell_of({p.x(), p.y(), p.z()}), kRootEdge);
    };
    const Coord first = root(low - openvdb::Vec3d(reach_ + margin));
    const Coord last = root(low + openvdb::Vec3d(cell_ + reach_ + margin));
    for (int x = first.x; x <= last.x; x += kRootEdge) {
      for (int y = first.y; y <= last.y; y += kRootEdge) {
        for (int z = first.z; z <= last.z; z += kRootEdge) {
          if (roots.empty() || roots.back() != Coord{x, y, z}) roots.push_back({x, y, z});
        }
      }
    }
    if (roots.size() > (1u << 20)) {
      std::sort(roots.begin(), roots.end());
      roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    }
  }
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  return roots;
}

}  // namespace leafhull
