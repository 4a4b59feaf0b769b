// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <random>
#include <set>

#include "density/band.h"
#include "unit/density_reference.h"

namespace leafhull {
namespace {

using reference::random_kernels;
using reference::sphere;
using reference::weighted;

constexpr Vec3d kFar{1e4, -2e4, 3e3};

KernelSet on_lattice(std::span<const Kernel> kernels, const Lattice& lattice) {
  return {kernels, reference::hash_of(kernels), lattice, 2};
}

/// |U d|^2 from the triangular factor.
double square_of(const LatticeKernel& k, Vec3d local) {
  const Vec3d d = local - to_vec3d(k.cell) - Vec3d(k.offset);
  const double x = k.xx * d.x + k.xy * d.y + k.xz * d.z;
  const double y = k.yy * d.y + k.yz * d.z;
  const double z = k.zz * d.z;
  return x * x + y * y + z * z;
}

TEST(LatticeKernel, HasTheXiOfItsAxes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const float thinnest : {0.2f, 0.002f}) {
    const Lattice lattice = Lattice::near(kFar, 0.25);
    for (const Kernel& kernel : random_kernels(200, 4, thinnest, kFar)) {
      const LatticeKernel local = to_lattice(kernel, lattice, 2);
      for (int i = 0; i < 20; ++i) {
        const Vec3d d = Vec3d(unit(random), unit(random), unit(random)) * 1.5;
        const double xi = reference::xi(kernel, kernel.centre + d);
        // The float's rounding scales with lengths in units of the smallest radius.
        EXPECT_NEAR(std::sqrt(square_of(local, lattice.local(kernel.centre + d))), std::sqrt(xi),
                    1e-6 * 1.5 / static_cast<double>(thinnest) + 1e-6);
      }
    }
  }
}

TEST(LatticeKernel, CarriesItsWeight) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  const Lattice lattice = Lattice::near(kFar, 0.25);
  auto kernels = random_kernels(50, 4, 0.2f, kFar);
  kernels.push_back(sphere(kFar, 0.7f));
  for (const int k : {1, 2, 3}) {
    for (const float weight : {1e-6f, 0.03f, 1.0f, 50.0f, 1e6f}) {
      for (Kernel kernel : kernels) {
        kernel.weight = weight;
        const LatticeKernel local = to_lattice(kernel, lattice, k);
        for (int i = 0; i < 20; ++i) {
          const Vec3d d = Vec3d(unit(random), unit(random), unit(random)) * 0.7;
          const double xi = reference::xi(kernel, kernel.centre + d);
          const double w =
              static_cast<double>(local.top) - square_of(local, lattice.local(kernel.centre + d));
          EXPECT_NEAR(std::pow(std::max(w, 0.0), k) / static_cast<double>(weight),
                      xi < 1 ? std::pow(1 - xi, k) : 0, 3e-5);
        }
      }
    }
  }
}

TEST(LatticeKernel, IsTheSameBitsForAnyFalloffWhereItsWeightIs1) {
  const Lattice lattice = Lattice::near(kFar, 0.25);
  auto kernels = random_kernels(50, 4, 0.002f, kFar);
  kernels.push_back(sphere(kFar, 0.7f));
  for (const Kernel& kernel : kernels) {
    const LatticeKernel one = to_lattice(kernel, lattice, 1);
    EXPECT_EQ(one.top, 1);
    for (const int k : {2, 3}) {
      const LatticeKernel other = to_lattice(kernel, lattice, k);
      EXPECT_EQ(std::memcmp(&one, &other, sizeof one), 0);
    }
  }
}

TEST(OctantLists, OfASphereAndEightCubes) {
  // Octants of edge 2 around (6, 1, 1), a sphere of radius 3 at the origin.
  for (const float weight : {1.0f, 1e-6f, 7.0f, 1e6f}) {
    const std::vector<LatticeKernel> local{to_lattice(sphere({0, 0, 0}, 3, weight), {1, {}}, 1)};
    const std::vector<std::uint32_t> ranks{0};
    OctantLists octants;
    octants.narrow(local, ranks, {{}, {3, 1, 1}, 1, 1}, 3, 1);
    // Octant 0 is the cube from (1, -1, -1) to (3, 1, 1), where 1 / 9 <= xi <= 11 / 9.
    EXPECT_EQ(octants.list(0).size(), 1u);
    const double share = octants.high(0) / static_cast<double>(weight);
    EXPECT_NEAR(share, 1 - 1.0 / 9, 1e-3);
    EXPECT_GE(share, 1 - 1.0 / 9);
    EXPECT_EQ(octants.low(0), 0);
    // Octant 7 is the cube from (3, 1, 1) to (5, 3, 3), beyond the sphere.
    EXPECT_TRUE(octants.list(7).empty());
  }
}

class Weights : public testing::TestWithParam<int> {
 protected:
  /// Random kernels have weights from 10^-decades to 10^decades.
  int decades() const { return GetParam(); }
  std::vector<Kernel> kernels(std::size_t count, double extent, float smallest = 0.2f,
                              Vec3d corner = {}) const {
    return weighted(random_kernels(count, extent, smallest, corner), decades());
  }
};
INSTANTIATE_TEST_SUITE_P(Decades, Weights, testing::Values(0, 1, 6));

TEST_P(Weights, OctantsBoundEverySample) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto kernels = this->kernels(400, 3);
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.25);
  for (const int falloff : {1, 2, 3}) {
    std::vector<LatticeKernel> local;
    std::vector<std::uint32_t> ranks;
    for (const Kernel& kernel : kernels) {
      ranks.push_back(static_cast<std::uint32_t>(local.size()));
      local.push_back(to_lattice(kernel, lattice, falloff));
    }
    int undecided = 0;
    for (int trial = 0; trial < 30; ++trial) {
      const Vec3f centre(Vec3d(unit(random), unit(random), unit(random)) * 6 + Vec3d(6, 6, 6));
      OctantLists octants;
      octants.narrow(local, ranks, {{}, centre, 0.6f, 0.4f}, 4, falloff);
      for (int o = 0; o < 8; ++o) {
        const auto listed = octants.list(o);
        EXPECT_TRUE(std::is_sorted(listed.begin(), listed.end()));
        std::vector<Kernel> near;
        for (const std::uint32_t rank : listed) near.push_back(kernels[rank]);
        const Vec3d middle =
            Vec3d(centre) + Vec3d(o & 4 ? 1 : -1, o & 2 ? 1 : -1, o & 1 ? 1 : -1) * 0.6;
        for (int i = 0; i < 20; ++i) {
          const Vec3d p =
              lattice.world(middle + Vec3d(unit(random), unit(random), unit(random)) * 0.4);
          const double n = reference::density(kernels, p, falloff);
          EXPECT_LE(octants.low(o), n);
          EXPECT_GE(octants.high(o), n);
          EXPECT_NEAR(reference::density(near, p, falloff), n, 1e-12 * (1 + n))
              << "a kernel is not listed";
          undecided += octants.low(o) > 0 && octants.high(o) < 3 * n;
        }
      }
    }
    EXPECT_GT(undecided, 100) << "the bounds say little";
  }
}

TEST(SpatialHash, RanksEveryKernelByCellThenIndex) {
  const auto kernels = random_kernels(2000, 20, 0.2f, kFar);
  const SpatialHash hash(kernels, Lattice::near(kFar, 1.5));
  std::vector<std::uint32_t> seen(hash.order().begin(), hash.order().end());
  for (std::size_t rank = 1; rank < seen.size(); ++rank) {
    const auto cell = [&](std::size_t r) {
      return cell_of(hash.cells().local(kernels[seen[r]].centre));
    };
    if (cell(rank) == cell(rank - 1)) {
      EXPECT_LT(seen[rank - 1], seen[rank]);
    }
  }
  std::sort(seen.begin(), seen.end());
  for (std::uint32_t k = 0; k < kernels.size(); ++k) ASSERT_EQ(seen[k], k);
}

TEST(KernelSet, GathersWhatIsNearInAscendingOrder) {
  for (const Vec3d corner : {Vec3d{}, kFar}) {
    const auto kernels = random_kernels(2000, 20, 0.2f, corner);
    const Lattice lattice = Lattice::near(corner, 0.25);
    const KernelSet set = on_lattice(kernels, lattice);
    float reach = 0;
    for (const Kernel& k : kernels) {
      reach = std::max({reach, k.radius_major, k.radius_minor, k.radius_normal});
    }
    EXPECT_NEAR(set.reach(), reach / 0.25, 1e-5);
    const Vec3d low = lattice.local(corner + Vec3d(5, 6, 7)), high = low + Vec3d(8, 9, 10);
    std::vector<std::uint32_t> ranks;
    set.gather(low, high, ranks);
    EXPECT_TRUE(std::is_sorted(ranks.begin(), ranks.end()));
    EXPECT_LT(ranks.size(), kernels.size() / 2);
    std::set<std::uint32_t> found;
    for (const std::uint32_t rank : ranks) found.insert(set.hash().order()[rank]);
    EXPECT_EQ(found.size(), ranks.size());
    const double r = reach / 0.25;
    for (std::uint32_t k = 0; k < kernels.size(); ++k) {
      const Vec3d c = lattice.local(kernels[k].centre);
      const bool near = c.x >= low.x - r && c.x <= high.x + r && c.y >= low.y - r &&
                        c.y <= high.y + r && c.z >= low.z - r && c.z <= high.z + r;
      if (near) {
        EXPECT_TRUE(found.count(k)) << k;
      }
    }
  }
}

struct Band {
  std::map<Coord, std::vector<std::uint32_t>> bricks;
  std::vector<InsideBlock> inside;
};

Band band_of(const KernelSet& kernels, const BandOptions& options) {
  Band band;
  band.inside = find_band(kernels, options, [&](const BrickList& list, double) {
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
  for (const auto& [block, threshold] : band.inside) {
    if (block_origin(s, block.edge) == block.origin) return Verdict::inside;
  }
  return Verdict::outside;
}

TEST_P(Weights, LetTheBandDecideOnlyWhatTheDensityBearsOut) {
  const auto kernels = this->kernels(3000, 6, 0.3f);
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.03);
  const KernelSet set = on_lattice(kernels, lattice);
  const double t = 1;
  const Band band = band_of(set, {{t}});
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

TEST_P(Weights, LetTheBandEvaluateBothSidesOfEveryCrossing) {
  const auto kernels = this->kernels(400, 4, 0.3f);
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.1);
  const KernelSet set = on_lattice(kernels, lattice);
  const double t = 1.5;
  const Band band = band_of(set, {{t}});
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

TEST(Band, SeveralThresholdsAreDecidedEachAsAlone) {
  const auto kernels = random_kernels(100, 1, 0.6f);
  const KernelSet set = on_lattice(kernels, Lattice::near({0, 0, 0}, 0.015));
  const std::vector<double> thresholds{1, 10, 25};
  const Band band = band_of(set, {thresholds});
  std::set<double> proven;
  for (const InsideBlock& block : band.inside) proven.insert(block.threshold);
  EXPECT_EQ(proven, std::set<double>(thresholds.begin(), thresholds.end()));
  std::size_t evaluated = 0;
  for (const double t : thresholds) {
    const Band alone = band_of(set, {{t}});
    evaluated += alone.bricks.size();
    for (const auto& [origin, list] : alone.bricks) EXPECT_TRUE(band.bricks.count(origin));
    // Samples that are not evaluated are proven as for this threshold alone, in blocks of any size.
    std::mt19937 random(5);
    std::uniform_int_distribution<int> place(-70, 140);
    for (int i = 0; i < 3000; ++i) {
      const Coord s{place(random), place(random), place(random)};
      const Verdict expected = verdict(alone, s);
      if (verdict(band, s) == Verdict::evaluated) continue;
      const auto holds = [&](const InsideBlock& inside) {
        return inside.threshold >= t && block_origin(s, inside.block.edge) == inside.block.origin;
      };
      const bool inside = std::any_of(band.inside.begin(), band.inside.end(), holds);
      EXPECT_EQ(inside ? Verdict::inside : Verdict::outside, expected) << t;
    }
  }
  EXPECT_LT(band.bricks.size(), evaluated);
}

TEST_P(Weights, LeaveBrickListsThoseOfTheDenseSearch) {
  const auto kernels = this->kernels(800, 6, 0.3f, kFar);
  const KernelSet set = on_lattice(kernels, Lattice::near(kFar, 0.1));
  const Band band = band_of(set, {{1.5}});
  const Band dense = band_of(set, {});
  EXPECT_GT(dense.bricks.size(), band.bricks.size());
  for (const auto& [origin, list] : band.bricks) {
    ASSERT_TRUE(dense.bricks.count(origin));
    EXPECT_EQ(dense.bricks.at(origin), list);
    EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
  }
}

}  // namespace
}  // namespace leafhull
