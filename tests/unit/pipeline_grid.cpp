// SPDX-License-Identifier: Apache-2.0
// The grid of a tree, and the memory that its field would need.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "density/band.h"
#include "leafhull/error.h"
#include "pipeline/grid.h"
#include "pipeline/memory.h"

namespace leafhull {
namespace {

/// Leaves along x, from 0 to 10.
LeafSet ten_long() {
  LeafSet leaves;
  for (const double x : {0.0, 10.0}) {
    leaves.vertices.push_back({{x, 0, 0}, {0, 0, 1}, {1, 0, 0}, 0.5f, 0.25f, 0});
    leaves.bounds.include({x, 0, 0});
  }
  leaves.crown = leaves.bounds;
  leaves.leaf_count = 1;
  return leaves;
}

Options with_voxels(double voxel_size) {
  Options options;
  options.style = Style::paper_thin;
  options.radius_max = 1;
  options.radius_unit = RadiusUnit::model;
  options.voxel_size = voxel_size;
  return resolve(options);
}

TEST(Grid, ItsResolutionIsTheNearestWholeNumber) {
  const Grid grid = grid_of(ten_long(), with_voxels(0.64));
  EXPECT_EQ(grid.radius_max, 1);
  EXPECT_EQ(grid.voxel_size, 0.64);
  EXPECT_EQ(grid.resolution, 19) << "12 / 0.64 = 18.75";
  EXPECT_EQ(grid_of(ten_long(), with_voxels(0.65)).resolution, 18) << "18.46";
}

/// One kernel with samples for its whole support.
struct OneKernel {
  std::vector<Kernel> kernels{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1, 1, 1}};
  Grid grid{.radius_max = 1, .voxel_size = 0.05, .resolution = 40, .lattice = {}};
  FieldOptions field{.kernels = {}, .voxel_size = 0.05, .margin = 1, .dense = true};
  std::shared_ptr<const SpatialHash> hash =
      std::make_shared<const SpatialHash>(kernels, Lattice::near({0, 0, 0}, 1));

  double samples() const {
    const KernelSet set(kernels, hash, Lattice::near({0, 0, 0}, grid.voxel_size), 2);
    double bricks = 0;
    find_band(set, {.falloff = 2},
              [&](const BrickList& list, double) { bricks += static_cast<double>(list.size()); });
    return bricks * kBrickSamples;
  }

  FieldMemory memory(double available) const {
    Box bounds;
    bounds.include({0, 0, 0});
    return {kernels, hash, bounds, grid, field, {}, static_cast<std::uint64_t>(available)};
  }
};

// A sample takes 23 bytes, as measured.
TEST(FieldMemory, IsToldBeforeItIsTaken) {
  const OneKernel one;
  const double samples = one.samples();
  ASSERT_GT(samples, 50'000);
  EXPECT_TRUE(one.memory(30 * samples).fits());
  EXPECT_NO_THROW(one.memory(30 * samples).check());
  EXPECT_FALSE(one.memory(20 * samples).fits());
  try {
    one.memory(20 * samples).check();
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(error.remedy().find("--resolution 37"), std::string::npos)
        << "0.98 * 40 * (20 / 23)^(1/3): " << error.remedy();
  }
}

}  // namespace
}  // namespace leafhull
