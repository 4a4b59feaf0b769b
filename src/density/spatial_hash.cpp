// SPDX-License-Identifier: Apache-2.0
#include "density/spatial_hash.h"

#include <openvdb/tools/PointIndexGrid.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace leafhull {
namespace {

using Grid = openvdb::tools::PointIndexGrid;
using Leaf = Grid::TreeType::LeafNodeType;

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
  static constexpr int kEdge = Leaf::DIM;

  Coord origin;
  std::uint32_t first;                        // rank
  std::array<std::uint32_t, Leaf::SIZE> end;  // ranks before the end of each cell, from first

  std::uint32_t begin_of(int cell) const { return first + (cell > 0 ? end[cell - 1] : 0); }
  std::uint32_t end_of(int cell) const { return first + end[cell]; }
};

SpatialHash::SpatialHash(std::span<const Kernel> kernels, const Lattice& cells)
    : SpatialHash(centres_of(kernels), cells) {}

SpatialHash::SpatialHash(std::span<const Vec3d> centres, const Lattice& cells) : cells_(cells) {
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  transform->postTranslate(openvdb::Vec3d(0.5));  // cells start at whole numbers
  const Grid::Ptr grid =
      openvdb::tools::createPointIndexGrid<Grid>(Centres{centres, cells_}, *transform);

  std::vector<const Leaf*> leaves;
  grid->tree().getNodes(leaves);
  std::sort(leaves.begin(), leaves.end(),
            [](const Leaf* a, const Leaf* b) { return a->origin() < b->origin(); });
  nodes_.resize(leaves.size());
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const openvdb::Coord o = leaves[i]->origin();
    nodes_[i].origin = {o.x(), o.y(), o.z()};
    nodes_[i].first = first;
    first += static_cast<std::uint32_t>(leaves[i]->indices().size());
  }
  order_.resize(first);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t i) {
    std::copy_n(leaves[i]->buffer().data(), Leaf::SIZE, nodes_[i].end.begin());
    const auto& indices = leaves[i]->indices();
    std::copy(indices.begin(), indices.end(), order_.begin() + nodes_[i].first);
    // The partitioner promises no order within a cell.
    for (int cell = 0; cell < static_cast<int>(Leaf::SIZE); ++cell) {
      std::sort(order_.begin() + nodes_[i].begin_of(cell), order_.begin() + nodes_[i].end_of(cell));
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
    for (int cell = 0; cell < static_cast<int>(Leaf::SIZE); ++cell) {
      if (node.begin_of(cell) == node.end_of(cell)) continue;
      const openvdb::Coord c = Leaf::offsetToLocalCoord(static_cast<openvdb::Index>(cell));
      const Vec3d low = to_vec3d(node.origin + Coord{c.x(), c.y(), c.z()});
      boxes.push_back({cells_.world(low), cells_.world(low + Vec3d(1, 1, 1))});
    }
  }
  return boxes;
}

}  // namespace leafhull
