// SPDX-License-Identifier: Apache-2.0
// Rays against N = T: compares both variants of the OpenCL kernels with the float64 reference.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <random>

#include "density/band.h"
#include "density/field_grid.h"
#include "device/evaluator.h"
#include "device/ray_caster.h"
#include "unit/density_reference.h"
#include "unit/device_variants.h"

namespace leafhull {
namespace {

using reference::random_kernels;
using reference::sphere;
using test::device;

constexpr double kThreshold = 0.5;

/// Kernels, their field on a lattice and the grid that rays walk.
struct Subject {
  std::vector<Kernel> kernels;
  Lattice lattice;
  KernelSet set;
  Field field;
  BrickList lists;
  std::optional<BrickGrid> grid;
  int falloff;

  Subject(std::vector<Kernel> all, double voxel_size, Device& device, int k = 2)
      : kernels(std::move(all)),
        lattice(Lattice::near(kernels.front().centre, voxel_size)),
        set(kernels, reference::hash_of(kernels), lattice, k),
        field(lattice, kThreshold),
        falloff(k) {
    Evaluator evaluator(device, set, k);
    const auto inside = find_band(set, {.thresholds = {kThreshold}, .falloff = k},
                                  [&](const BrickList& bricks, double) {
                                    std::vector<float> samples(bricks.size() * kBrickSamples);
                                    evaluator.sample(bricks, samples);
                                    field.add_bricks(bricks.origins, samples);
                                    lists.append(bricks);
                                  });
    field.add_inside(inside);
    grid.emplace(field);
  }

  RayCaster exact(Device& device) const {
    return RayCaster(device, *grid, kThreshold, set, lists, falloff);
  }
  RayCaster sampled(Device& device) const { return RayCaster(device, *grid, kThreshold); }

  /// N - T at a point in voxels.
  double excess(Vec3d p) const {
    return reference::density(kernels, lattice.world(p), falloff) - kThreshold;
  }
};

/// Rays from a sphere of radius `far` around `middle` through points of a box of half edge
/// `spread`.
std::vector<VoxelRay> random_rays(std::size_t count, Vec3f middle, float far, float spread) {
  std::mt19937 random(11);
  std::normal_distribution<float> gauss;
  std::uniform_real_distribution<float> unit(-1, 1);
  std::vector<VoxelRay> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3f from =
        middle + normalized(Vec3f(gauss(random), gauss(random), gauss(random))) * far;
    const Vec3f to = middle + Vec3f(unit(random), unit(random), unit(random)) * spread;
    rays.push_back({from, normalized(to - from)});
  }
  return rays;
}

class RaysTest : public test::VariantTest {};

INSTANTIATE_TEST_SUITE_P(Variants, RaysTest,
                         testing::Combine(testing::Values("vector", "work-item"),
                                          testing::Values(1, 2, 3)),
                         test::name_of);

TEST_P(RaysTest, MeetASphereWhereItIs) {
  // One kernel: N = w (1 - r^2)^k is 0.5 at a radius computed by hand. A heavy kernel rises in far
  // less than the 0.02 voxels to which a crossing is known.
  for (const auto& [weight, near] :
       {std::pair(1.0f, 0.002), {0.9f, 0.002}, {3.0f, 0.002}, {1e3f, 0.021}, {1e6f, 0.021}}) {
    const double radius =
        10 * std::sqrt(1 - std::pow(kThreshold / static_cast<double>(weight), 1.0 / falloff()));
    const Vec3d centre{3.3, -40.2, 7.7};
    const Subject subject({sphere(centre, 10, weight)}, 1, chosen(), falloff());
    const Vec3d c = subject.lattice.local(centre);
    const VoxelRay rays[] = {
        {Vec3f(c) + Vec3f(0, 0, 100), {0, 0, -1}},  {Vec3f(c) + Vec3f(0, 3, 50), {0, 0, -1}},
        {Vec3f(c) + Vec3f(0, 0, 100), {0, 0, 1}},   {Vec3f(c) + Vec3f(-2000, 0, 0), {1, 0, 0}},
        {Vec3f(c) + Vec3f(0, 200, 20), {0, -1, 0}}, {Vec3f(c), {0, 1, 0}}};
    std::vector<VoxelHit> hits(6);
    subject.exact(chosen()).closest(rays, hits);
    EXPECT_NEAR(hits[0].distance, 100 - radius, near);
    EXPECT_NEAR(hits[1].distance, 50 - std::sqrt(radius * radius - 9), near);
    EXPECT_TRUE(std::isinf(hits[2].distance));
    EXPECT_NEAR(hits[3].distance, 2000 - radius, near);
    EXPECT_TRUE(std::isinf(hits[4].distance));
    EXPECT_NEAR(hits[5].distance, radius, near);  // from inside
    // If the surface is that close to the end of the support, there may be no gradient.
    if (10 - radius < 0.05) continue;
    const Vec3f n = normalized(-hits[1].gradient);
    EXPECT_NEAR(n.y, 3 / radius, 1e-3);
    EXPECT_NEAR(n.x, 0, 1e-4);
  }
}

TEST_P(RaysTest, StopAtTheFirstCrossingOfTheExactDensity) {
  for (const double decades : {0.0, 1.0}) {
    const Subject subject(reference::weighted(random_kernels(400, 4, 0.15f), decades), 0.08,
                          chosen(), falloff());
    const auto rays = random_rays(1500, Vec3f(subject.lattice.local({2, 2, 2})), 200, 25);
    std::vector<VoxelHit> hits(rays.size());
    subject.exact(chosen()).closest(rays, hits);
    int met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto at = [&](double t) {
        return Vec3d(rays[i].origin) + Vec3d(rays[i].direction) * t;
      };
      const double end = std::isinf(hits[i].distance) ? 400 : static_cast<double>(hits[i].distance);
      // The ray has passed nothing that is a voxel thick.
      int run = 0;
      for (double t = 100; t < end - 0.05; t += 0.25) {
        run = subject.excess(at(t)) > 0.01 ? run + 1 : 0;
        ASSERT_LT(run, 4) << "ray " << i << " at " << t << " of " << end;
      }
      if (std::isinf(hits[i].distance)) continue;
      ++met;
      // N passes T within 0.02 voxels along the ray.
      EXPECT_LT(subject.excess(at(end - 0.02)), 1e-4) << i;
      EXPECT_GT(subject.excess(at(end + 0.02)), -1e-4) << i;
      const Vec3d p = at(end);
      Vec3d g;
      constexpr double kStep = 1e-4;
      g.x = subject.excess(p + Vec3d(kStep, 0, 0)) - subject.excess(p - Vec3d(kStep, 0, 0));
      g.y = subject.excess(p + Vec3d(0, kStep, 0)) - subject.excess(p - Vec3d(0, kStep, 0));
      g.z = subject.excess(p + Vec3d(0, 0, kStep)) - subject.excess(p - Vec3d(0, 0, kStep));
      const double cosine = dot(normalized(g), normalized(Vec3d(hits[i].gradient)));
      EXPECT_GT(cosine, falloff() == 1 ? 0.9 : 0.999) << i;
    }
    EXPECT_GT(met, 1000);
  }
}

TEST_P(RaysTest, MeetTheSameAloneAndTogether) {
  const Subject subject(random_kernels(400, 4, 0.15f), 0.08, chosen(), falloff());
  const auto rays = random_rays(333, Vec3f(subject.lattice.local({2, 2, 2})), 200, 25);
  RayCaster caster = subject.exact(chosen());
  std::vector<VoxelHit> all(rays.size()), again(rays.size()), one(1);
  caster.closest(rays, all);
  caster.closest(rays, again);
  EXPECT_EQ(std::memcmp(all.data(), again.data(), all.size() * sizeof(VoxelHit)), 0);
  for (std::size_t i = 0; i < rays.size(); i += 7) {
    caster.closest(std::span(rays).subspan(i, 1), one);
    if (std::isinf(all[i].distance)) {
      EXPECT_TRUE(std::isinf(one[0].distance)) << i;
    } else {
      EXPECT_NEAR(one[0].distance, all[i].distance, 0.005) << i;
    }
  }
}

TEST(Rays, FromSamplesAgreeWithThoseFromKernels) {
  Device& cpu = device("vector");
  const Subject subject(random_kernels(400, 4, 0.5f), 0.04, cpu);
  const auto rays = random_rays(500, Vec3f(subject.lattice.local({2, 2, 2})), 300, 50);
  std::vector<VoxelHit> exact(rays.size()), sampled(rays.size());
  subject.exact(cpu).closest(rays, exact);
  subject.sampled(cpu).closest(rays, sampled);
  int compared = 0, apart = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (std::isinf(exact[i].distance)) continue;
    ++compared;
    const double cosine =
        dot(normalized(Vec3d(exact[i].gradient)), normalized(Vec3d(sampled[i].gradient)));
    apart += std::fabs(exact[i].distance - sampled[i].distance) > 0.2f || cosine < 0.98;
  }
  EXPECT_GT(compared, 400);
  EXPECT_LT(apart, compared / 20);
}

TEST(Rays, PassThroughWhatIsNotDrawn) {
  Device& cpu = device("vector");
  // Two balls in a row, of which the first is not drawn.
  Subject subject({sphere({0, 0, 0}, 10), sphere({40, 0, 0}, 10)}, 1, cpu);
  const double radius = 10 * std::sqrt(1 - std::sqrt(kThreshold));
  std::vector<Coord> drawn, others;
  for (const Brick* brick : bricks_of(subject.field)) {
    for (int s = 0; s < kBrickSamples; ++s) {
      const Coord cell{brick->origin().x() + (s >> 6), brick->origin().y() + (s >> 3 & 7),
                       brick->origin().z() + (s & 7)};
      const Vec3d p = subject.lattice.world(to_vec3d(cell) + Vec3d(0.5, 0.5, 0.5));
      if (std::fabs(length(p - Vec3d(40, 0, 0)) - radius) < 1.5) drawn.push_back(cell);
      if (std::fabs(length(p) - radius) < 1.5) others.push_back(cell);
    }
  }
  const VoxelRay ray{Vec3f(subject.lattice.local({-60, 0, 0})), {1, 0, 0}};
  VoxelHit hit;
  const auto distance = [&] {
    subject.exact(cpu).closest({&ray, 1}, {&hit, 1});
    return hit.distance;
  };
  EXPECT_NEAR(distance(), 60 - radius, 0.01);
  subject.grid->draw_only(drawn, others);
  EXPECT_NEAR(distance(), 100 - radius, 0.01);
  float blocked = 2;
  subject.exact(cpu).blocked({&ray, 1}, 1e-6f, 90, {&blocked, 1});
  EXPECT_EQ(blocked, 0);
  subject.exact(cpu).blocked({&ray, 1}, 1e-6f, 110, {&blocked, 1});
  EXPECT_EQ(blocked, 1);
}

TEST(Rays, AreBlockedByWhatLiesAboveT) {
  Device& cpu = device("vector");
  // N is 1 in the middle, twice T.
  const Subject subject({sphere({0, 0, 0}, 10)}, 1, cpu);
  const auto at = [&](Vec3d p) { return VoxelRay{Vec3f(subject.lattice.local(p)), {1, 0, 0}}; };
  const double y = 4;  // along this ray N is at most (1 - 0.16)^2
  const VoxelRay rays[] = {at({-30, 0, 0}), at({-30, y, 0}), at({-30, 0, 6}), at({10, 0, 0})};
  std::vector<float> blocked(4);
  subject.exact(cpu).blocked(rays, kThreshold, 100, blocked);
  EXPECT_NEAR(blocked[0], 1, 0.02);
  EXPECT_NEAR(blocked[1], (0.7056 - kThreshold) / kThreshold, 0.03);
  EXPECT_EQ(blocked[2], 0);
  EXPECT_EQ(blocked[3], 0);
  subject.exact(cpu).blocked(rays, kThreshold, 22, blocked);  // ends before the surface
  EXPECT_EQ(blocked[0], 0);
}

TEST(Rays, ToTheLightComeFromAsFarAsTheyLike) {
  Device& cpu = device("vector");
  const Subject subject({sphere({0, 0, 0}, 10)}, 1, cpu);
  std::vector<VoxelRay> rays;
  for (const float far : {1e3f, 1e5f, 1e7f}) {
    rays.push_back({Vec3f(subject.lattice.local({-far, 0, 0})), {1, 0, 0}});
    rays.push_back({Vec3f(subject.lattice.local({-far, 0, 12})), {1, 0, 0}});
  }
  std::vector<float> blocked(rays.size());
  subject.exact(cpu).blocked(rays, kThreshold, HUGE_VALF, blocked);
  for (std::size_t i = 0; i < rays.size(); i += 2) {
    EXPECT_GT(blocked[i], 0.5f) << i;
    EXPECT_EQ(blocked[i + 1], 0) << i;
  }
}

TEST(Rays, EndInACrownOfAnyLength) {
  Device& cpu = device("vector");
  // At 100,000 voxels a float cannot hold the small step over the edge of a block.
  const double far = 1e5, radius = 10 * std::sqrt(1 - std::sqrt(kThreshold));
  const Subject subject({sphere({0, 0, 0}, 10), sphere({far, 0, 0}, 10)}, 1, cpu);
  // A ray towards -x on the edge of a block is still in the block that it leaves.
  const auto at = [&](Vec3d p) { return VoxelRay{Vec3f(subject.lattice.local(p)), {-1, 0, 0}}; };
  const VoxelRay rays[] = {at({far - 50, 0, 0}), at({far - 50, 20, 0})};
  std::vector<VoxelHit> hits(2);
  subject.exact(cpu).closest(rays, hits);
  EXPECT_NEAR(hits[0].distance, far - 50 - radius, 0.05);
  EXPECT_TRUE(std::isinf(hits[1].distance));
  std::vector<float> blocked(2);
  subject.exact(cpu).blocked(rays, kThreshold, HUGE_VALF, blocked);
  EXPECT_GT(blocked[0], 0.5f);
  EXPECT_EQ(blocked[1], 0);
}

TEST(Rays, WhatIsNotDrawnCastsNoShadow) {
  Device& cpu = device("vector");
  // The ball is so large that bricks in its middle are proven inside.
  Subject subject({sphere({0, 0, 0}, 120), sphere({300, 0, 0}, 10)}, 1, cpu);
  ASSERT_FALSE(subject.field.inside().empty());
  const VoxelRay ray{Vec3f(subject.lattice.local({-200, 0, 0})), {1, 0, 0}};
  float blocked = 2;
  subject.exact(cpu).blocked({&ray, 1}, 1e-6f, 400, {&blocked, 1});
  EXPECT_EQ(blocked, 1);
  subject.grid->draw_only({}, {});
  subject.exact(cpu).blocked({&ray, 1}, 1e-6f, 400, {&blocked, 1});
  EXPECT_EQ(blocked, 0);
}

}  // namespace
}  // namespace leafhull
