// SPDX-License-Identifier: Apache-2.0
// Compares both variants of the OpenCL kernels with the float64 reference, on the default CPU
// device.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <random>

#include "density/band.h"
#include "device/engine.h"
#include "device/evaluator.h"
#include "leafhull/error.h"
#include "unit/density_reference.h"
#include "unit/device_variants.h"

namespace leafhull {
namespace {

using reference::random_kernels;
using reference::sphere;
using test::device;

class EvaluatorTest : public test::VariantTest {};

INSTANTIATE_TEST_SUITE_P(Variants, EvaluatorTest,
                         testing::Combine(testing::Values("vector", "work-item"),
                                          testing::Values(1, 2, 3)),
                         test::name_of);

TEST_P(EvaluatorTest, SamplesAgreeWithFloat64) {
  for (const Vec3d corner : {Vec3d{}, Vec3d{1e4, -2e4, 3e3}}) {
    const auto kernels = random_kernels(600, 3, 0.15f, corner);
    const Lattice lattice = Lattice::near(corner, 0.1);
    const KernelSet set(kernels, reference::hash_of(kernels), lattice, falloff());
    Evaluator evaluator(chosen(), set, falloff());
    double worst = 0;
    std::uint64_t pairs = 0, compared = 0;
    find_band(set, {.falloff = falloff()}, [&](const BrickList& bricks, double) {
      std::vector<float> samples(bricks.size() * kBrickSamples);
      pairs += evaluator.sample(bricks, samples);
      for (std::size_t b = 0; b < bricks.size(); b += 5) {
        for (int s = 0; s < kBrickSamples; s += 7) {
          const Coord at = bricks.origins[b] + Coord{s >> 6, s >> 3 & 7, s & 7};
          const double n = reference::density(kernels, lattice.world(to_vec3d(at)), falloff());
          worst = std::max(worst, std::fabs(n - samples[b * kBrickSamples + s]) / (1 + n));
          ++compared;
        }
      }
    });
    EXPECT_LT(worst, 1e-5);
    EXPECT_GT(compared, 1000u);
    EXPECT_GT(pairs, 0u);
  }
}

TEST_P(EvaluatorTest, WeightedSamplesAgreeWithFloat64) {
  for (const double decades : {1.0, 6.0}) {
    const auto kernels = reference::weighted(random_kernels(600, 3, 0.15f), decades);
    const Lattice lattice = Lattice::near({0, 0, 0}, 0.1);
    const KernelSet set(kernels, reference::hash_of(kernels), lattice, falloff());
    Evaluator evaluator(chosen(), set, falloff());
    std::uint64_t compared = 0;
    find_band(set, {.falloff = falloff()}, [&](const BrickList& bricks, double) {
      std::vector<float> samples(bricks.size() * kBrickSamples);
      evaluator.sample(bricks, samples);
      for (std::size_t b = 0; b < bricks.size(); b += 5) {
        for (int s = 0; s < kBrickSamples; s += 7) {
          const Coord at = bricks.origins[b] + Coord{s >> 6, s >> 3 & 7, s & 7};
          const Vec3d p = lattice.world(to_vec3d(at));
          const double n = reference::density(kernels, p, falloff());
          EXPECT_NEAR(samples[b * kBrickSamples + s], n, 1e-5 * reference::weight_near(kernels, p));
          compared += n > 0;
        }
      }
    });
    EXPECT_GT(compared, 1000u);
  }
}

/// N at `points`, which are in voxels from the anchor.
std::vector<float> density_at(Evaluator& evaluator, const KernelSet& set,
                              std::span<const Vec3d> points) {
  std::vector<float> density(points.size(), -1);
  find_kernels_near(set, points, {Within::point, evaluator.chunk_points()}, [&](PointBatch& batch) {
    const auto values = evaluator.density(batch);
    for (std::size_t i = 0; i < values.size(); ++i) density[batch.index[i]] = values[i];
  });
  return density;
}

struct Snapped {
  std::vector<Vec3d> points;
  std::vector<Vec3f> normals;
};

Snapped snap(Evaluator& evaluator, const KernelSet& set, std::span<const Vec3d> points,
             double threshold, int steps) {
  Snapped snapped{std::vector<Vec3d>(points.size()), std::vector<Vec3f>(points.size())};
  find_kernels_near(set, points, {Within::cell, evaluator.chunk_points()}, [&](PointBatch& batch) {
    const Evaluator::Normals n = evaluator.snap(batch, threshold, steps);
    for (const PointGroup& group : batch.groups) {
      const std::size_t first = group.chunk * batch.chunk_points;
      for (std::size_t i = first; i < first + group.count * batch.chunk_points; ++i) {
        const Vec3d offset(Vec3f(batch.x[i], batch.y[i], batch.z[i]));
        snapped.points[batch.index[i]] = to_vec3d(group.origin) + offset;
        snapped.normals[batch.index[i]] = {n.x[i], n.y[i], n.z[i]};
      }
    }
  });
  return snapped;
}

TEST_P(EvaluatorTest, PointsAgreeWithFloat64) {
  for (const double decades : {0.0, 1.0, 6.0}) {
    const auto kernels = reference::weighted(random_kernels(600, 3, 0.15f), decades);
    const Lattice lattice = Lattice::near({0, 0, 0}, 0.1);
    const KernelSet set(kernels, reference::hash_of(kernels), lattice, falloff());
    Evaluator evaluator(chosen(), set, falloff());
    std::vector<Vec3d> points;
    for (const Kernel& k : kernels) points.push_back(lattice.local(k.centre));
    const std::vector<float> density = density_at(evaluator, set, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double n = reference::density(kernels, kernels[i].centre, falloff());
      EXPECT_NEAR(density[i], n, 1e-5 * reference::weight_near(kernels, kernels[i].centre));
    }
  }
}

TEST_P(EvaluatorTest, OnePointOfOneKernelByHand) {
  // At (0.5, 0, 0) in a unit sphere xi = 0.5^2 = 0.25, so D = w 0.75^k.
  for (const float weight : {1.0f, 1e-6f, 8.0f, 1e6f}) {
    const std::vector<Kernel> kernels{sphere({0, 0, 0}, 1, weight)};
    const Lattice lattice = Lattice::near({0, 0, 0}, 0.25);
    const KernelSet set(kernels, reference::hash_of(kernels), lattice, falloff());
    Evaluator evaluator(chosen(), set, falloff());
    const std::vector<Vec3d> points{lattice.local({0.5, 0, 0}), lattice.local({0, 0, 1}),
                                    lattice.local({50, 60, 70})};
    const std::vector<float> density = density_at(evaluator, set, points);
    EXPECT_NEAR(density[0] / weight, std::pow(0.75, falloff()), 1e-6);
    EXPECT_NEAR(density[1] / weight, 0, 1e-6);
    EXPECT_EQ(density[2], 0);
  }
}

TEST_P(EvaluatorTest, APointDoesNotDependOnItsCompany) {
  const auto kernels = random_kernels(600, 3, 0.05f);
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.1);
  const KernelSet set(kernels, reference::hash_of(kernels), lattice, falloff());
  Evaluator evaluator(chosen(), set, falloff());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 30);
  std::vector<Vec3d> all, some;
  for (int i = 0; i < 3000; ++i) {
    all.push_back(Vec3d(Vec3f(Vec3d(unit(random), unit(random), unit(random)))));
    if (i % 7 == 0) some.push_back(all.back());
  }
  const double t = 1;
  const auto density = density_at(evaluator, set, all), few = density_at(evaluator, set, some);
  const Snapped snapped = snap(evaluator, set, all, t, 12),
                moved = snap(evaluator, set, some, t, 12);
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(few[i], density[7 * i]);
    EXPECT_EQ(moved.points[i], snapped.points[7 * i]);
    EXPECT_EQ(moved.normals[i], snapped.normals[7 * i]);
  }
}

TEST_P(EvaluatorTest, SnapsOntoAnEllipsoid) {
  // For one kernel with radii 2, 1, 0.5, N = T where xi = 1 - (T / w)^(1/k).
  for (const auto& [weight, t] : {std::pair(1.0f, 0.4), {2.0f, 0.4}, {1e-6f, 2e-7}, {1e6f, 5e5}}) {
    const std::vector<Kernel> kernels{{{0.3, 0.2, 0.1}, {0, 0, 1}, {1, 0, 0}, 2, 1, 0.5f, weight}};
    const Lattice lattice = Lattice::near({0, 0, 0}, 0.1);
    const KernelSet set(kernels, reference::hash_of(kernels), lattice, falloff());
    Evaluator evaluator(chosen(), set, falloff());
    const double shrink = std::sqrt(1 - std::pow(t / static_cast<double>(weight), 1.0 / falloff()));
    std::mt19937 random(2);
    std::normal_distribution<double> gauss;
    std::vector<Vec3d> points;
    for (int i = 0; i < 200; ++i) {
      const Vec3d d = normalized(Vec3d(gauss(random), gauss(random), gauss(random)));
      const Vec3d on(2 * d.x, d.y, 0.5 * d.z);
      const Vec3d p = lattice.local(kernels[0].centre + on * shrink);
      // The centre of the cell that the surface crosses here.
      points.push_back(to_vec3d(cell_of(p)) + Vec3d(0.5, 0.5, 0.5));
    }
    const Snapped snapped = snap(evaluator, set, points, t, 12);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3d local = snapped.points[i];
      const Vec3d from = points[i];
      for (const double step : {local.x - from.x, local.y - from.y, local.z - from.z}) {
        EXPECT_LE(std::fabs(step), 0.5 + 1e-5) << "left its cell";
      }
      const Vec3d p = lattice.world(local) - kernels[0].centre;
      const Vec3d outward = normalized(Vec3d(p.x / 4, p.y, p.z * 4));
      EXPECT_NEAR(length(Vec3d(p.x / 2, p.y, p.z * 2)) / shrink, 1, 2e-2);
      EXPECT_GT(dot(outward, Vec3d(snapped.normals[i])), 0.999);
    }
  }
}

// Newton's steps go straight to a sphere. If they fail, the search goes towards a corner of the
// cell and ends elsewhere.
TEST_P(EvaluatorTest, ThreeStepsGoStraightToASphere) {
  const std::vector<Kernel> kernels{sphere({0.3, 0.2, 0.1}, 2)};
  const double t = 0.4, radius = 2 * std::sqrt(1 - std::pow(t, 1.0 / falloff()));
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.1);
  const KernelSet set(kernels, reference::hash_of(kernels), lattice, falloff());
  Evaluator evaluator(chosen(), set, falloff());
  std::vector<Vec3d> points;
  for (int i = 0; i < 64; ++i) {
    const Vec3d d(std::cos(0.7 * i) * std::cos(0.1 * i), std::sin(0.1 * i),
                  std::sin(0.7 * i) * std::cos(0.1 * i));
    const Vec3d p = lattice.local(kernels[0].centre + d * radius);
    const Vec3d middle = to_vec3d(cell_of(p)) + Vec3d(0.5, 0.5, 0.5);
    points.push_back(p + (middle - p) * 0.5);
  }
  const Snapped snapped = snap(evaluator, set, points, t, 3);
  std::size_t straight = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3d outward = normalized(lattice.world(points[i]) - kernels[0].centre);
    const Vec3d moved = snapped.points[i] - points[i];
    straight += length(moved - outward * dot(moved, outward)) < 5e-3;
    EXPECT_NEAR(length(lattice.world(snapped.points[i]) - kernels[0].centre), radius, 1e-4);
  }
  EXPECT_GE(straight, 60u) << "of 64: a step may slide along a face of its cell";
}

TEST_P(EvaluatorTest, SnapsWhereNewtonHasNoWay) {
  // At the far corner of the cell N and its gradient are zero; only the other corners show a way.
  const std::vector<Kernel> kernels{sphere({0, 0, 0}, 0.8f)};
  const double t = 0.3;
  const Lattice lattice = Lattice::near({0, 0, 0}, 1);
  const KernelSet set(kernels, reference::hash_of(kernels), lattice, falloff());
  Evaluator evaluator(chosen(), set, falloff());
  const std::vector<Vec3d> points{{0.9, 0.9, 0.9}, {-0.9, 0.8, -0.9}};
  const Snapped snapped = snap(evaluator, set, points, t, 12);
  const double radius = 0.8 * std::sqrt(1 - std::pow(t, 1.0 / falloff()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(length(snapped.points[i]), radius, 2e-3);
    EXPECT_GT(dot(normalized(points[i]), Vec3d(snapped.normals[i])), 0.99);
    EXPECT_EQ(cell_of(snapped.points[i]), cell_of(points[i]));
  }
}

TEST(Device, VariantsAgreeToRounding) {
  const auto kernels = random_kernels(800, 3, 0.1f);
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.1);
  const KernelSet set(kernels, reference::hash_of(kernels), lattice, 2);
  Evaluator vector(device("vector"), set, 2);
  Evaluator work_item(device("work-item"), set, 2);
  find_band(set, {}, [&](const BrickList& bricks, double) {
    std::vector<float> a(bricks.size() * kBrickSamples), b(a.size());
    const auto pairs = vector.sample(bricks, a);
    EXPECT_LT(pairs, work_item.sample(bricks, b)) << "sub-bricks are not culled";
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      worst = std::max(worst, static_cast<double>(std::fabs(a[i] - b[i]) / (1 + b[i])));
    }
    EXPECT_LT(worst, 1e-5);
  });
}

TEST(Device, ThinKernelsLoseNoSamples) {
  // The radii are far below a voxel: the sample at the centre sees the kernel, its neighbours do
  // not.
  std::vector<Kernel> kernels{{{1.5, 2.5, 3.5}, {0, 0, 1}, {1, 0, 0}, 0.01f, 0.01f, 0.01f}};
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.5);
  const KernelSet set(kernels, reference::hash_of(kernels), lattice, 2);
  Evaluator evaluator(device("vector"), set, 2);
  int ones = 0, others = 0;
  find_band(set, {}, [&](const BrickList& bricks, double) {
    std::vector<float> samples(bricks.size() * kBrickSamples);
    evaluator.sample(bricks, samples);
    for (const float n : samples) n == 1 ? ++ones : others += n != 0;
  });
  EXPECT_EQ(ones, 1);
  EXPECT_EQ(others, 0);
}

TEST_P(EvaluatorTest, PreparingBuildsWhatEvaluatingNeeds) {
  Device prepared =
      open_device({.choice = "", .threads = 0, .variant = std::get<0>(GetParam())}, falloff())
          .get();
  ASSERT_EQ(prepared.engine().programs.size(), 1u);
  const cl_program built = prepared.engine().programs.begin()->second();

  const std::vector<Kernel> kernels{sphere({0, 0, 0}, 1)};
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.25);
  const KernelSet set(kernels, reference::hash_of(kernels), lattice, falloff());
  Evaluator evaluator(prepared, set, falloff());
  float highest = 0;
  find_band(set, {.falloff = falloff()}, [&](const BrickList& bricks, double) {
    std::vector<float> samples(bricks.size() * kBrickSamples);
    evaluator.sample(bricks, samples);
    highest = std::max(highest, *std::max_element(samples.begin(), samples.end()));
  });
  EXPECT_EQ(highest, 1);  // at the sphere's centre
  EXPECT_EQ(prepared.engine().programs.size(), 1u);
  EXPECT_EQ(prepared.engine().programs.begin()->second(), built);
}

TEST(Device, AKernelThatDoesNotBuildShowsItsLog) {
  try {
    device("vector").engine().build({"kernel void broken() { no_such_name(); }"}, "");
    FAIL() << "built";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::device);
    EXPECT_NE(std::string(error.what()).find("no_such_name"), std::string::npos) << error.what();
  }
}

TEST(Device, ADeviceThatIsNotThereIsNamed) {
  try {
    Device missing({.choice = "no such device", .threads = 0, .variant = ""});
    FAIL() << "opened";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::device);
    EXPECT_NE(std::string(error.what()).find("no such device"), std::string::npos);
  }
}

TEST(Device, OpeningOnAThreadTellsTheSameErrorsWhenItIsAskedForTheDevice) {
  for (const int threads : {0, 1}) {
    std::future<Device> missing =
        open_device({.choice = "no such device", .threads = threads, .variant = ""}, 2);
    std::future<Device> unknown =
        open_device({.choice = "", .threads = threads, .variant = "no such variant"}, 2);
    try {
      missing.get();
      FAIL() << "opened";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::device);
    }
    try {
      unknown.get();
      FAIL() << "opened";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::usage);
    }
  }
}

TEST(Device, AnOpenedDeviceThatNobodyAsksForIsGivenBack) {
  { const std::future<Device> unused = open_device({}, 2); }
  EXPECT_NO_THROW(Device({}));
}

TEST(Device, TheListMarksTheOneInUse) {
  const auto devices = list_devices({});
  ASSERT_FALSE(devices.empty());
  int chosen = 0;
  for (const DeviceInfo& info : devices) {
    chosen += info.chosen;
    EXPECT_FALSE(info.reason.empty());
  }
  EXPECT_EQ(chosen, 1);
}

}  // namespace
}  // namespace leafhull
