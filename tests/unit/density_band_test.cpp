// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "density/band.h"
#include "density/points.h"
#include "unit/density_reference.h"

namespace leafhull {
namespace {

using reference::random_kernels;
using reference::sphere;

constexpr Vec3d kFar{1e4, -2e4, 3e3};

TEST(Bounds, OfASphereAndABox) {
  const LatticeKernel kernel = to_lattice(sphere({0, 0, 0}, 2), {1, {}});
  const Interval xi = xi_bounds(kernel.axes, {5, 0, 0}, 1);
  EXPECT_FLOAT_EQ(xi.low, 4.0f);                   // (4 / 2)^2
  EXPECT_FLOAT_EQ(xi.high, 9.0f + 0.25f + 0.25f);  // (6 / 2)^2 and twice (1 / 2)^2
}

TEST(Bounds, HoldEverySampleOfABox) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const Kernel& kernel : random_kernels(200, 4)) {
    const LatticeKernel local = to_lattice(kernel, {1, {}});
    const Vec3d q = kernel.centre + Vec3d(unit(random), unit(random), unit(random)) * 3;
    const Interval xi = xi_bounds(local.axes, Vec3f(q - kernel.centre), 0.5f);
    for (int i = 0; i < 50; ++i) {
      const Vec3d p = q + Vec3d(unit(random), unit(random), unit(random)) * 0.5;
      const double x = reference::xi(kernel, p);
      EXPECT_LE(xi.low, x * (1 + 1e-5) + 1e-6);
      EXPECT_GE(xi.high, x * (1 - 1e-5) - 1e-6);
    }
  }
}

TEST(KernelHash, GathersWhatIsNearInAscendingOrder) {
  for (const Vec3d corner : {Vec3d{}, kFar}) {
    const auto kernels = random_kernels(2000, 20, 0.2f, corner);
    const Lattice lattice = Lattice::near(corner, 0.25);
    const KernelHash hash(kernels, lattice);
    float reach = 0;
    for (const Kernel& k : kernels) {
      reach = std::max({reach, k.radius_major, k.radius_minor, k.radius_normal});
    }
    const Vec3d low = lattice.local(corner + Vec3d(5, 6, 7)), high = low + Vec3d(8, 9, 10);
    std::vector<std::uint32_t> found;
    hash.gather(low, high, found);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_LT(found.size(), kernels.size() / 2);
    const std::set<std::uint32_t> set(found.begin(), found.end());
    EXPECT_EQ(set.size(), found.size());
    const double r = reach / 0.25;
    for (std::uint32_t k = 0; k < kernels.size(); ++k) {
      const Vec3d c = lattice.local(kernels[k].centre);
      const bool near = c.x >= low.x - r && c.x <= high.x + r && c.y >= low.y - r &&
                        c.y <= high.y + r && c.z >= low.z - r && c.z <= high.z + r;
      if (near) {
        EXPECT_TRUE(set.count(k)) << k;
      }
    }
  }
}

struct Band {
  std::map<Coord, std::vector<std::uint32_t>> bricks;
  std::vector<Block> inside;
};

Band band_of(const KernelHash& hash, const BandOptions& options) {
  Band band;
  band.inside = find_band(hash, options, [&](const BrickList& list, double) {
    for (std::size_t b = 0; b < list.size(); ++b) {
      band.bricks[list.origins[b]] = {list.kernels.begin() + list.first[b],
                                      list.kernels.begin() + list.first[b + 1]};
    }
  });
  return band;
}

/// What the band says of a sample: evaluated, inside or, if neither, outside.
enum class Verdict { evaluated, inside, outside };
Verdict verdict(const Band& band, Coord s) {
  if (band.bricks.count(block_origin(s, kBrickEdge))) return Verdict::evaluated;
  for (const Block& b : band.inside) {
    if (block_origin(s, b.edge) == b.origin) return Verdict::inside;
  }
  return Verdict::outside;
}

TEST(Band, DecidesOnlyWhatTheDensityBearsOut) {
  const auto kernels = random_kernels(3000, 6, 0.3f);
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.03);
  const KernelHash hash(kernels, lattice);
  const double t = 1;
  const Band band = band_of(hash, {t, t});
  EXPECT_FALSE(band.inside.empty());
  EXPECT_FALSE(band.bricks.empty());
  std::mt19937 random(5);
  std::uniform_int_distribution<int> place(-60, 260);
  int seen[3] = {};
  for (int i = 0; i < 3000; ++i) {
    const Coord s{place(random), place(random), place(random)};
    const double n = reference::density(kernels, lattice.world(to_vec3d(s)), 2);
    const Verdict v = verdict(band, s);
    ++seen[static_cast<int>(v)];
    if (v == Verdict::inside) {
      EXPECT_GE(n, t);
    }
    if (v == Verdict::outside) {
      EXPECT_LT(n, t);
    }
  }
  for (const int count : seen) EXPECT_GT(count, 0);
}

TEST(Band, EvaluatesBothSidesOfEveryCrossing) {
  const auto kernels = random_kernels(400, 4, 0.3f);
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.1);
  const KernelHash hash(kernels, lattice);
  const double t = 1.5;
  const Band band = band_of(hash, {t, t});
  const auto inside = [&](Coord s) {
    return reference::density(kernels, lattice.world(to_vec3d(s)), 2) >= t;
  };
  int crossings = 0;
  for (int x = -12; x < 52; x += 3) {
    for (int y = -12; y < 52; y += 3) {
      bool before = inside({x, y, -13});
      for (int z = -12; z < 52; ++z) {
        const bool now = inside({x, y, z});
        if (now != before) {
          ++crossings;
          EXPECT_EQ(verdict(band, {x, y, z}), Verdict::evaluated);
          EXPECT_EQ(verdict(band, {x, y, z - 1}), Verdict::evaluated);
        }
        before = now;
      }
    }
  }
  EXPECT_GT(crossings, 100);
}

TEST(Band, BrickListsAreThoseOfTheDenseSearch) {
  const auto kernels = random_kernels(800, 6, 0.3f, kFar);
  const KernelHash hash(kernels, Lattice::near(kFar, 0.1));
  const Band band = band_of(hash, {1.5, 1.5});
  const Band dense = band_of(hash, {});
  EXPECT_GT(dense.bricks.size(), band.bricks.size());
  for (const auto& [origin, list] : band.bricks) {
    ASSERT_TRUE(dense.bricks.count(origin));
    EXPECT_EQ(dense.bricks.at(origin), list);
    EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
  }
}

TEST(Points, EveryPointGetsTheKernelsThatReachIt) {
  const auto kernels = random_kernels(1500, 8, 0.2f);
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.1);
  const KernelHash hash(kernels, lattice);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-30, 110);
  std::vector<Vec3d> points;
  for (int i = 0; i < 1500; ++i) points.emplace_back(place(random), place(random), place(random));

  std::vector<std::set<std::uint32_t>> near(points.size());
  find_kernels_near(hash, points, 2, [&](const PointBatch& batch) {
    for (std::size_t b = 0; b < batch.bricks.size(); ++b) {
      for (auto i = batch.first_point[b]; i < batch.first_point[b + 1]; ++i) {
        const Vec3d p = to_vec3d(batch.bricks.origins[b]) + Vec3d(batch.offset[i]);
        EXPECT_LT(length(p - points[batch.index[i]]), 1e-5);
        EXPECT_TRUE(near[batch.index[i]].empty()) << "a point in two bricks";
        near[batch.index[i]].insert(batch.bricks.kernels.begin() + batch.bricks.first[b],
                                    batch.bricks.kernels.begin() + batch.bricks.first[b + 1]);
      }
    }
  });
  int reached = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::uint32_t k = 0; k < kernels.size(); ++k) {
      if (reference::xi(kernels[k], lattice.world(points[i])) >= 1) continue;
      ++reached;
      EXPECT_TRUE(near[i].count(k));
    }
  }
  EXPECT_GT(reached, 500);
}

}  // namespace
}  // namespace leafhull
