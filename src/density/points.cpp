// SPDX-License-Identifier: Apache-2.0
#include "density/points.h"

#include <tbb/parallel_sort.h>

#include <tuple>

#include "density/batches.h"

namespace leafhull {
namespace {

/// Where a point lies: its root block, its brick in the order of a descent, and which point it is.
struct Place {
  Coord root;
  std::uint32_t brick;
  std::uint32_t index;
  friend bool operator<(const Place& a, const Place& b) {
    return std::tie(a.root, a.brick, a.index) < std::tie(b.root, b.brick, b.index);
  }
};

/// The rank of a cell's brick among the 64 of its root: the octants of both levels, outer first.
std::uint32_t brick_rank(Coord cell) {
  const auto octant = [&](int bit) {
    return static_cast<std::uint32_t>((cell.x >> bit & 1) << 2 | (cell.y >> bit & 1) << 1 |
                                      (cell.z >> bit & 1));
  };
  return octant(4) << 3 | octant(3);
}

std::vector<Place> sorted_places(std::span<const Vec3d> points) {
  std::vector<Place> places(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Coord cell = cell_of(points[i]);
    places[i] = {block_origin(cell, kRootEdge), brick_rank(cell), i};
  }
  tbb::parallel_sort(places);
  return places;
}

/// The points of one root block, taken brick by brick as a descent reaches them.
class Queue {
 public:
  explicit Queue(std::span<const Place> places) : rest_(places) {}

  bool any_in(const Block& block) const {
    return !rest_.empty() && rest_.front().brick < rank_end(block);
  }

  std::span<const Place> take(const Block& block) {
    std::size_t n = 0;
    while (n < rest_.size() && rest_[n].brick < rank_end(block)) ++n;
    const auto taken = rest_.first(n);
    rest_ = rest_.subspan(n);
    return taken;
  }

 private:
  // Bricks of a block are neighbours in rank: 64 ranks in a root, 8 in its octants, 1 in a brick.
  static std::uint32_t rank_end(const Block& block) {
    const auto bricks = static_cast<std::uint32_t>(block.edge / kBrickEdge);
    return brick_rank(block.origin) + bricks * bricks * bricks;
  }

  std::span<const Place> rest_;
};

}  // namespace

void find_kernels_near(const KernelSet& kernels, std::span<const Vec3d> points, int falloff,
                       const PointVisitor& visit) {
  const std::vector<Place> places = sorted_places(points);
  std::vector<std::span<const Place>> roots;
  for (std::size_t begin = 0, end = 0; begin < places.size(); begin = end) {
    while (end < places.size() && places[end].root == places[begin].root) ++end;
    roots.push_back(std::span(places).subspan(begin, end - begin));
  }

  const auto search = [&](Descent& descent, std::span<const Place> root, PointBatch& found) {
    Queue queue(root);
    const auto enter = [&](const Block& block) { return queue.any_in(block); };
    const auto collect = [&](const Block& block, std::span<const std::uint32_t> near,
                             const Descent::Bounds&) {
      if (!near.empty() && block.edge > kBrickEdge) return true;
      const auto taken = queue.take(block);
      if (near.empty()) return false;
      for (const Place& place : taken) {
        found.index.push_back(place.index);
        found.offset.push_back(Vec3f(points[place.index] - to_vec3d(block.origin)));
      }
      found.bricks.add(block.origin, near);
      found.first_point.push_back(static_cast<std::uint32_t>(found.index.size()));
      return false;
    };
    descent.from(root.front().root, enter, collect);
  };
  const auto join = [](PointBatch& all, const PointBatch& found) {
    const std::uint32_t offset = all.first_point.back();
    all.bricks.append(found.bricks);
    for (std::size_t b = 1; b < found.first_point.size(); ++b) {
      all.first_point.push_back(offset + found.first_point[b]);
    }
    all.index.insert(all.index.end(), found.index.begin(), found.index.end());
    all.offset.insert(all.offset.end(), found.offset.begin(), found.offset.end());
  };
  const auto flush = [&](const PointBatch& found, double) {
    if (!found.index.empty()) visit(found);
  };
  constexpr int kMargin =
      1;  // a point may move within its cell, whose upper faces are the next brick's
  in_batches<PointBatch>(
      roots, [&] { return Descent(kernels, falloff, kMargin); }, search, join, flush);
}

}  // namespace leafhull
