// SPDX-License-Identifier: Apache-2.0
// Lists of the kernels near points.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

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

  Vec3d somewhere(std::mt19937& random) const {
    std::normal_distribution<double> gauss(0.5, 0.2);
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

TEST(Points, EachComesOnceWithAllKernelsThatReachIt) {
  const Near near;
  std::mt19937 random(5);
  std::vector<Vec3d> points;
  for (int i = 0; i < 2000; ++i) points.push_back(near.somewhere(random));
  for (const auto& [within, chunk_points] :
       {std::pair(Within::point, 8u), {Within::cell, 8u}, {Within::cell, 16u}}) {
    std::vector<int> chunks_with(points.size());
    std::size_t reached = 0, listed = 0;
    find_kernels_near(near.set, points, within, chunk_points, [&](const PointBatch& batch) {
      for (std::size_t c = 0; c < batch.chunks.size(); ++c) {
        const PointChunk& chunk = batch.chunks[c];
        const auto list = std::span(batch.kernels).subspan(chunk.first, chunk.end - chunk.first);
        EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
        if (!list.empty()) {
          EXPECT_LT(list.back(), near.kernels.size());
        }
        std::set<std::uint32_t> indices;
        for (std::size_t i = c * chunk_points; i < (c + 1) * chunk_points; ++i) {
          const Vec3d at =
              to_vec3d(chunk.origin) + Vec3d(Vec3f(batch.x[i], batch.y[i], batch.z[i]));
          EXPECT_LT(length(at - points[batch.index[i]]), 1e-5);
          if (!indices.insert(batch.index[i]).second) continue;
          ++chunks_with[batch.index[i]];
          const Vec3d cell = to_vec3d(cell_of(at));
          const Vec3d moved = within == Within::point ? at : cell + Vec3d(1, 0, 1);
          listed += list.size();
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
    EXPECT_LT(listed, 15 * reached) << "the lists say little";
  }
}

TEST(Points, ManyInOnePlaceComeInBatches) {
  const Near near;
  const std::vector<Vec3d> points(100000, near.lattice.local(near.kernels.front().centre));
  std::size_t batches = 0, seen = 0;
  find_kernels_near(near.set, points, Within::point, 8, [&](const PointBatch& batch) {
    ++batches;
    seen += batch.index.size();
    EXPECT_LE(batch.chunks.size(), std::size_t{1} << 15);
  });
  EXPECT_GT(batches, 1u);
  EXPECT_EQ(seen, points.size());
}

TEST(Points, NoneAreNoBatch) {
  const Near near;
  find_kernels_near(near.set, std::span<const Vec3d>(), Within::point, 8,
                    [](const PointBatch&) { FAIL(); });
}

}  // namespace
}  // namespace leafhull
