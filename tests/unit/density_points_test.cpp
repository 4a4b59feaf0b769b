// SPDX-License-Identifier: Apache-2.0
// Lists of the kernels near points.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "density/band.h"
#include "density/points.h"
#include "unit/density_reference.h"

namespace leafhull {
namespace {

using reference::random_kernels;

struct Near {
  Lattice lattice = Lattice::near({1e4, -2e4, 3e3}, 0.1);
  std::vector<Kernel> kernels =
      reference::weighted(random_kernels(3001, 5, 0.05f, {1e4, -2e4, 3e3}), 6);
  KernelSet set{kernels, reference::hash_of(kernels), lattice, 2};

  Vec3d somewhere(std::mt19937& random, double spread = 0.2) const {
    std::normal_distribution<double> gauss(0.5, spread);
    return lattice.local(Vec3d(1e4, -2e4, 3e3) +
                         Vec3d(gauss(random), gauss(random), gauss(random)) * 5.0);
  }
};

TEST(SpatialHash, RanksKernelsOfACellByTheirIndex) {
  const std::vector<Vec3d> centres(1000, Vec3d(0.5, 0.5, 0.5));
  const SpatialHash hash(centres, Lattice::near({0, 0, 0}, 1));
  ASSERT_EQ(hash.order().size(), centres.size());
  for (std::uint32_t rank = 0; rank < centres.size(); ++rank) EXPECT_EQ(hash.order()[rank], rank);
}

/// The group of a chunk.
const PointGroup& group_of(const PointBatch& batch, std::size_t chunk) {
  return *std::find_if(batch.groups.begin(), batch.groups.end(), [&](const PointGroup& group) {
    return chunk >= group.chunk && chunk < group.chunk + group.count;
  });
}

/// Whether a point, from the group's origin, lies in the box of a chunk.
bool holds(const ChunkBoxes& boxes, std::size_t chunk, Vec3d p) {
  const auto within = [&](std::size_t axis, double at) {
    return std::abs(at - static_cast<double>(boxes[axis][chunk])) <=
           static_cast<double>(boxes[axis + 3][chunk]);
  };
  return within(0, p.x) && within(1, p.y) && within(2, p.z);
}

/// Whether a kernel gets a mark for a chunk, as points.cl decides it.
bool is_marked(const LatticeKernel& k, const PointGroup& group, const ChunkBoxes& boxes,
               std::size_t chunk) {
  const Vec3d centre = to_vec3d(k.cell) + Vec3d(k.offset) - to_vec3d(group.origin);
  const auto along = [&](std::size_t row) { return static_cast<double>(boxes[row][chunk]); };
  const Vec3d d = Vec3d(along(0), along(1), along(2)) - centre, h(along(3), along(4), along(5));
  const Vec3d x = Vec3d(Vec3f(k.xx, k.xy, k.xz)), y = Vec3d(Vec3f(0, k.yy, k.yz));
  const auto beyond = [&](Vec3d row) {
    const Vec3d size(std::abs(row.x), std::abs(row.y), std::abs(row.z));
    return std::max(std::abs(dot(row, d)) - dot(size, h), 0.0);
  };
  const Vec3d least(beyond(x), beyond(y), beyond(Vec3d(0, 0, static_cast<double>(k.zz))));
  return dot(least, least) < static_cast<double>(k.top);
}

void expect_each_once_with_all_that_reach_it(double spread) {
  const Near near;
  std::mt19937 random(5);
  std::vector<Vec3d> points;
  for (int i = 0; i < 2000; ++i) points.push_back(near.somewhere(random, spread));
  BrickList known;
  find_band(near.set, {}, [&](const BrickList& bricks, double) { known.append(bricks); });
  for (const PointSearch& how : {PointSearch{Within::point, 8, nullptr},
                                 {Within::cell, 8, nullptr},
                                 {Within::cell, 16, nullptr},
                                 {Within::cell, 16, &known}}) {
    const auto [within, chunk_points, lists] = how;
    SCOPED_TRACE(lists ? "known" : std::to_string(chunk_points));
    std::vector<int> chunks_with(points.size());
    std::size_t reached = 0, listed = 0, marked = 0;
    find_kernels_near(near.set, points, how, [&](const PointBatch& batch) {
      ASSERT_EQ(batch.groups.size(), batch.boxes.size());
      for (std::size_t c = 0; c < batch.index.size() / chunk_points; ++c) {
        const PointGroup& group = group_of(batch, c);
        ASSERT_LE(group.count, kGroupChunks);
        const ChunkBoxes& boxes =
            batch.boxes[static_cast<std::size_t>(&group - batch.groups.data())];
        const auto list =
            std::span(batch.bricks.kernels).subspan(group.first, group.end - group.first);
        EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
        if (!list.empty()) {
          EXPECT_LT(list.back(), near.kernels.size());
        }
        const auto summed = std::ranges::count_if(list, [&](std::uint32_t rank) {
          return is_marked(near.set.kernels()[rank], group, boxes, c - group.chunk);
        });
        std::set<std::uint32_t> indices;
        for (std::size_t i = c * chunk_points; i < (c + 1) * chunk_points; ++i) {
          const Vec3d offset(Vec3f(batch.x[i], batch.y[i], batch.z[i]));
          const Vec3d at = to_vec3d(group.origin) + offset;
          EXPECT_LT(length(at - points[batch.index[i]]), 1e-5);
          if (!indices.insert(batch.index[i]).second) continue;
          ++chunks_with[batch.index[i]];
          const Vec3d moved = within == Within::point ? at : to_vec3d(cell_of(at)) + Vec3d(1, 0, 1);
          EXPECT_TRUE(holds(boxes, c - group.chunk, offset));
          EXPECT_TRUE(holds(boxes, c - group.chunk, moved - to_vec3d(group.origin)));
          listed += list.size();
          marked += static_cast<std::size_t>(summed);
          for (std::uint32_t rank = 0; rank < near.kernels.size(); ++rank) {
            const Kernel& kernel = near.kernels[near.set.hash().order()[rank]];
            if (reference::xi(kernel, near.lattice.world(moved)) >= 1) continue;
            ++reached;
            EXPECT_TRUE(std::binary_search(list.begin(), list.end(), rank));
          }
        }
      }
    });
    EXPECT_TRUE(std::all_of(chunks_with.begin(), chunks_with.end(), [](int n) { return n == 1; }));
    EXPECT_GT(reached, 10000u);
    EXPECT_LT(marked, 15 * reached) << "the boxes say little";
    const bool is_dense = spread < 0.1;  // the lists of few points are not narrowed
    EXPECT_LT(listed, (is_dense ? 30 : 120) * reached) << "the lists say little";
  }
}

TEST(Points, EachComesOnceWithAllKernelsThatReachIt) {
  expect_each_once_with_all_that_reach_it(0.2);
}

TEST(Points, SoDoManyInAFewBricks) { expect_each_once_with_all_that_reach_it(0.03); }

TEST(Points, KnownListsAreTaken) {
  const Near near;
  const Vec3d point = near.lattice.local(near.kernels.front().centre);
  BrickList known;
  known.add(block_origin(cell_of(point), kBrickEdge), std::vector<std::uint32_t>{3, 5, 8});
  const Vec3d side(0, kBrickEdge, 0);
  const std::vector<Vec3d> points{point, point - side, point + side};
  std::vector<std::size_t> sizes;
  find_kernels_near(near.set, points, {Within::cell, 8, &known}, [&](const PointBatch& batch) {
    for (std::size_t b = 0; b < batch.bricks.size(); ++b) {
      sizes.push_back(batch.bricks.list(b).size());
    }
  });
  ASSERT_EQ(sizes.size(), 3u);
  EXPECT_EQ(std::ranges::count(sizes, 3u), 1) << "the lists of the bricks beside it are not known";
}

TEST(Points, ManyInOnePlaceComeInBatches) {
  const Near near;
  const std::vector<Vec3d> points(1000000, near.lattice.local(near.kernels.front().centre));
  std::size_t batches = 0, seen = 0;
  find_kernels_near(near.set, points, {Within::point, 8}, [&](const PointBatch& batch) {
    ++batches;
    seen += batch.index.size();
    EXPECT_LE(batch.index.size(), (std::size_t{1} << 18) + (std::size_t{1} << 14));
  });
  EXPECT_GT(batches, 1u);
  EXPECT_EQ(seen, points.size());
}

TEST(Points, KeepTheirCellWhereFloatsAreCoarse) {
  const Near near;
  // As a float the first one's offset from its frame would be 16.
  const std::vector<Vec3d> points{{-1e-8, 3.5, 3.5}, {7 - 1e-8, -1e-9, 3.5}, {-1e-17, 3.5, -1e-17}};
  find_kernels_near(near.set, points, {Within::cell, 8}, [&](const PointBatch& batch) {
    for (const PointGroup& group : batch.groups) {
      for (std::size_t i = group.chunk * 8; i < (group.chunk + group.count) * 8; ++i) {
        const Vec3d offset(Vec3f(batch.x[i], batch.y[i], batch.z[i]));
        EXPECT_EQ(cell_of(to_vec3d(group.origin) + offset), cell_of(points[batch.index[i]]));
      }
    }
  });
}

TEST(Points, NoneAreNoBatch) {
  const Near near;
  find_kernels_near(near.set, std::span<const Vec3d>(), {Within::point, 8},
                    [](const PointBatch&) { FAIL(); });
}

}  // namespace
}  // namespace leafhull
