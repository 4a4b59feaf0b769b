// SPDX-License-Identifier: Apache-2.0
// The OpenCL kernels against the float64 reference, both variants, on the default CPU device.
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

namespace leafhull {
namespace {

using reference::random_kernels;
using reference::sphere;

Device& device(const std::string& variant) {
  static Device vector({.choice = "", .threads = 0, .variant = "vector"});
  static Device work_item({.choice = "", .threads = 0, .variant = "work-item"});
  return variant == "vector" ? vector : work_item;
}

class EvaluatorTest : public testing::TestWithParam<std::tuple<const char*, int>> {
 protected:
  Device& chosen() { return device(std::get<0>(GetParam())); }
  int falloff() { return std::get<1>(GetParam()); }
};

std::string name_of(const testing::TestParamInfo<EvaluatorTest::ParamType>& test) {
  const bool vector = std::string(std::get<0>(test.param)) == "vector";
  return (vector ? "VectorK" : "WorkItemK") + std::to_string(std::get<1>(test.param));
}

INSTANTIATE_TEST_SUITE_P(Variants, EvaluatorTest,
                         testing::Combine(testing::Values("vector", "work-item"),
                                          testing::Values(1, 2, 3)),
                         name_of);

TEST_P(EvaluatorTest, SamplesAgreeWithFloat64) {
  for (const Vec3d corner : {Vec3d{}, Vec3d{1e4, -2e4, 3e3}}) {
    const auto kernels = random_kernels(600, 3, 0.15f, corner);
    const Lattice lattice = Lattice::near(corner, 0.1);
    const KernelHash hash(kernels, lattice);
    Evaluator evaluator(chosen(), kernels, lattice, falloff());
    double worst = 0;
    std::uint64_t pairs = 0, compared = 0;
    find_band(hash, {.falloff = falloff()}, [&](const BrickList& bricks, double) {
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

TEST_P(EvaluatorTest, PointsAgreeWithFloat64) {
  const auto kernels = random_kernels(600, 3, 0.15f);
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.1);
  const KernelHash hash(kernels, lattice);
  Evaluator evaluator(chosen(), kernels, lattice, falloff());
  std::vector<Vec3d> points;
  for (const Kernel& k : kernels) points.push_back(lattice.local(k.centre));
  std::size_t seen = 0;
  find_kernels_near(hash, points, falloff(), [&](const PointBatch& batch) {
    const std::vector<float> density = evaluator.density(batch);
    for (std::size_t i = 0; i < density.size(); ++i, ++seen) {
      const double n = reference::density(kernels, kernels[batch.index[i]].centre, falloff());
      EXPECT_NEAR(density[i], n, 1e-5 * (1 + n));
    }
  });
  EXPECT_EQ(seen, points.size());
}

TEST_P(EvaluatorTest, OnePointOfOneKernelByHand) {
  // xi = (0.5 / 1)^2 = 0.25 at (0.5, 0, 0) of a unit sphere: D = 0.75^k.
  const std::vector<Kernel> kernels{sphere({0, 0, 0}, 1)};
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.25);
  Evaluator evaluator(chosen(), kernels, lattice, falloff());
  const std::vector<Vec3d> points{lattice.local({0.5, 0, 0}), lattice.local({0, 0, 1})};
  std::vector<float> density(2, -1);
  find_kernels_near(KernelHash(kernels, lattice), points, falloff(), [&](const PointBatch& batch) {
    const auto values = evaluator.density(batch);
    for (std::size_t i = 0; i < values.size(); ++i) density[batch.index[i]] = values[i];
  });
  EXPECT_NEAR(density[0], std::pow(0.75, falloff()), 1e-6);
  EXPECT_NEAR(density[1], 0, 1e-6);
}

TEST_P(EvaluatorTest, SnapsOntoAnEllipsoid) {
  // One kernel of radii 2, 1, 0.5: N = T where xi = 1 - T^(1/k).
  const std::vector<Kernel> kernels{{{0.3, 0.2, 0.1}, {0, 0, 1}, {1, 0, 0}, 2, 1, 0.5f}};
  const double t = 0.4;
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.1);
  Evaluator evaluator(chosen(), kernels, lattice, falloff());
  const double shrink = std::sqrt(1 - std::pow(t, 1.0 / falloff()));
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
  int moved = 0;
  find_kernels_near(KernelHash(kernels, lattice), points, falloff(), [&](const PointBatch& batch) {
    const auto snapped = evaluator.snap(batch, t, 12);
    for (std::size_t b = 0; b < batch.bricks.size(); ++b) {
      for (auto i = batch.first_point[b]; i < batch.first_point[b + 1]; ++i, ++moved) {
        const Vec3d local = to_vec3d(batch.bricks.origins[b]) + Vec3d(snapped.offset[i]);
        const Vec3d from = points[batch.index[i]];
        for (const double step : {local.x - from.x, local.y - from.y, local.z - from.z}) {
          EXPECT_LE(std::fabs(step), 0.5 + 1e-5) << "left its cell";
        }
        const Vec3d p = lattice.world(local) - kernels[0].centre;
        const Vec3d outward = normalized(Vec3d(p.x / 4, p.y, p.z * 4));
        EXPECT_NEAR(length(Vec3d(p.x / 2, p.y, p.z * 2)) / shrink, 1, 2e-2);
        EXPECT_GT(dot(outward, Vec3d(snapped.normal[i])), 0.999);
      }
    }
  });
  EXPECT_EQ(moved, 200);
}

TEST(Device, VariantsAgreeToRounding) {
  const auto kernels = random_kernels(800, 3, 0.1f);
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.1);
  const KernelHash hash(kernels, lattice);
  Evaluator vector(device("vector"), kernels, lattice, 2);
  Evaluator work_item(device("work-item"), kernels, lattice, 2);
  find_band(hash, {}, [&](const BrickList& bricks, double) {
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
  // Radii far below a voxel: the sample at the centre must see its kernel, its neighbours nothing.
  std::vector<Kernel> kernels{{{1.5, 2.5, 3.5}, {0, 0, 1}, {1, 0, 0}, 0.01f, 0.01f, 0.01f}};
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.5);
  Evaluator evaluator(device("vector"), kernels, lattice, 2);
  int ones = 0, others = 0;
  find_band(KernelHash(kernels, lattice), {}, [&](const BrickList& bricks, double) {
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
  const cl_program built = prepared.engine().programs.at(falloff())();

  const std::vector<Kernel> kernels{sphere({0, 0, 0}, 1)};
  const Lattice lattice = Lattice::near({0, 0, 0}, 0.25);
  Evaluator evaluator(prepared, kernels, lattice, falloff());
  float highest = 0;
  find_band(KernelHash(kernels, lattice), {.falloff = falloff()},
            [&](const BrickList& bricks, double) {
              std::vector<float> samples(bricks.size() * kBrickSamples);
              evaluator.sample(bricks, samples);
              highest = std::max(highest, *std::max_element(samples.begin(), samples.end()));
            });
  EXPECT_EQ(highest, 1);  // at the sphere's centre
  EXPECT_EQ(prepared.engine().programs.size(), 1u);
  EXPECT_EQ(prepared.engine().programs.at(falloff())(), built);
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
