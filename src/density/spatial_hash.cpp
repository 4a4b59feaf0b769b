// SPDX-License-Identifier: Apache-2.0
#include "density/spatial_hash.h"

#include <openvdb/tools/PointPartitioner.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

namespace leafhull {
namespace {

using Partitioner = openvdb::tools::UInt32PointPartitioner;

/// Kernel centres as OpenVDB's PointArray, in cells from the anchor.
struct Centres {
  using PosType = openvdb::Vec3d;

  std::span<const Vec3d> centres;
  const Lattice& cells;

  std::size_t size() const { return centres.size(); }
  void getPos(std::size_t n, PosType& position) const {
    const Vec3d p = cells.local(centres[n]);
    position = {p.x, p.y, p.z};
  }
};

std::vector<Vec3d> centres_of(std::span<const Kernel> kernels) {
  std::vector<Vec3d> centres(kernels.size());
  std::transform(kernels.begin(), kernels.end(), centres.begin(),
                 [](const Kernel& kernel) { return kernel.centre; });
  return centres;
}

}  // namespace

struct SpatialHash::Node {
  static constexpr int kEdge = 1 << Partitioner::LOG2DIM;
  static constexpr int kCells = kEdge * kEdge * kEdge;

  Coord origin;
  std::uint32_t first;                    // rank
  std::array<std::uint32_t, kCells> end;  // ranks before the end of each cell, from first

  std::uint32_t begin_of(int cell) const { return first + (cell > 0 ? end[cell - 1] : 0); }
  std::uint32_t end_of(int cell) const { return first + end[cell]; }
};

SpatialHash::SpatialHash(std::span<const Kernel> kernels, const Lattice& cells)
    : SpatialHash(centres_of(kernels), cells) {}

SpatialHash::SpatialHash(std::span<const Vec3d> centres, const Lattice& cells) : cells_(cells) {
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  transform->postTranslate(openvdb::Vec3d(0.5));  // cells start at whole numbers
  Partitioner parts;
  parts.construct(Centres{centres, cells_}, *transform, /*voxelOrder=*/false,
                  /*recordVoxelOffsets=*/true);

  std::vector<std::size_t> ascending(parts.size());
  std::iota(ascending.begin(), ascending.end(), std::size_t{0});
  std::ranges::sort(ascending, {}, [&](std::size_t part) { return parts.origin(part); });
  nodes_.resize(ascending.size());
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const openvdb::Coord o = parts.origin(ascending[i]);
    nodes_[i].origin = {o.x(), o.y(), o.z()};
    nodes_[i].first = first;
    first += static_cast<std::uint32_t>(parts.indices(ascending[i]).size());
  }
  order_.resize(first);
  tbb::parallel_for(std::size_t{0}, nodes_.size(), [&](std::size_t i) {
    Node& node = nodes_[i];
    const std::span points(&*parts.indices(ascending[i]), parts.indices(ascending[i]).size());
    const auto cell = [&](std::uint32_t point) {
      return static_cast<std::size_t>(parts.voxelOffsets()[point]);
    };
    node.end.fill(0);
    for (const std::uint32_t point : points) ++node.end[cell(point)];
    std::exclusive_scan(node.end.begin(), node.end.end(), node.end.begin(), std::uint32_t{0});
    for (const std::uint32_t point : points) order_[node.first + node.end[cell(point)]++] = point;
    // The partitioner promises no order.
    for (int c = 0; c < Node::kCells; ++c) {
      std::sort(order_.begin() + node.begin_of(c), order_.begin() + node.end_of(c));
    }
  });
}

SpatialHash::~SpatialHash() = default;
SpatialHash::SpatialHash(SpatialHash&&) noexcept = default;

void SpatialHash::gather(Vec3d low, Vec3d high, std::vector<std::uint32_t>& ranks) const {
  ranks.clear();
  const Coord a = cell_of(cells_.local(low)), b = cell_of(cells_.local(high));
  const Coord from = block_origin(a, Node::kEdge), to = block_origin(b, Node::kEdge);
  const auto before = [](const Node& node, Coord origin) { return node.origin < origin; };
  for (int x = from.x; x <= to.x; x += Node::kEdge) {
    for (int y = from.y; y <= to.y; y += Node::kEdge) {
      auto node = std::lower_bound(nodes_.begin(), nodes_.end(), Coord{x, y, from.z}, before);
      for (; node != nodes_.end() && node->origin <= Coord{x, y, to.z}; ++node) {
        const auto first = [&](int at, int origin) { return std::max(at - origin, 0); };
        const auto last = [&](int at, int origin) {
          return std::min(at - origin, Node::kEdge - 1);
        };
        const Coord o = node->origin;
        for (int i = first(a.x, o.x); i <= last(b.x, o.x); ++i) {
          for (int j = first(a.y, o.y); j <= last(b.y, o.y); ++j) {
            const int row = (i * Node::kEdge + j) * Node::kEdge;
            const std::uint32_t begin = node->begin_of(row + first(a.z, o.z));
            const std::uint32_t end = node->end_of(row + last(b.z, o.z));
            const std::size_t size = ranks.size();
            ranks.resize(size + (end - begin));
            std::iota(ranks.begin() + static_cast<std::ptrdiff_t>(size), ranks.end(), begin);
          }
        }
      }
    }
  }
}

std::vector<Box> SpatialHash::occupied() const {
  std::vector<Box> boxes;
  for (const Node& node : nodes_) {
    for (int cell = 0; cell < Node::kCells; ++cell) {
      if (node.begin_of(cell) == node.end_of(cell)) continue;
      constexpr int kEdge = Node::kEdge;
      const Coord c{cell / (kEdge * kEdge), cell / kEdge % kEdge, cell % kEdge};
      const Vec3d low = to_vec3d(node.origin + c);
      boxes.push_back({cells_.world(low), cells_.world(low + Vec3d(1, 1, 1))});
    }
  }
  return boxes;
}

}  // namespace leafhull
