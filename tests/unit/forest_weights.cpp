// SPDX-License-Identifier: Apache-2.0
// A placed tree carries its model's density: N(p) = N_model(A^-1 (p - t)), weights included.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tiles/gather.h"
#include "tiles/tree_map.h"
#include "unit/density_reference.h"

namespace leafhull {
namespace {

/// A mirroring shear, a similarity and a tree that is only moved.
const std::vector<PlacedTree> kTrees{
    {.position = {1e3, -20, 7}, .linear = {-1.2f, 0.3f, 0, 0.1f, 0.8f, -0.4f, 0.2f, 0, 1.5f}},
    {.position = {1e3, -19, 8}, .linear = {0, -1.4f, 0, 1.4f, 0, 0, 0, 0, 1.4f}},
    {.position = {1e3, -20, 8}}};

Vec3d carried_by(const PlacedTree& tree, Vec3d p) { return TreeMap(tree)(p); }

/// D(p) of a kernel on a lattice; p is in voxels.
double density_of(const LatticeKernel& k, Vec3d p, int falloff) {
  const Vec3d d = p - to_vec3d(k.cell) - Vec3d(k.offset);
  const double x = k.xx * d.x + k.xy * d.y + k.xz * d.z;
  const double y = k.yy * d.y + k.yz * d.z;
  const double z = k.zz * d.z;
  return std::pow(std::max(static_cast<double>(k.top) - x * x - y * y - z * z, 0.0), falloff);
}

std::vector<Kernel> model_kernels() {
  auto kernels = reference::random_kernels(60, 2, 0.3f);
  for (std::size_t i = 0; i < kernels.size(); i += 2) {  // spheres become ellipsoids
    kernels[i].radius_minor = kernels[i].radius_normal = kernels[i].radius_major;
  }
  return reference::weighted(std::move(kernels), 3);
}

TEST(TreeMap, CarriesAKernelWithItsWeight) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-0.6, 0.6);
  const Lattice lattice = Lattice::near(kTrees[0].position, 0.1);
  for (const PlacedTree& tree : kTrees) {
    for (const Kernel& kernel : model_kernels()) {
      for (const int k : {1, 2, 3}) {
        const LatticeKernel carried = TreeMap(tree)(kernel, lattice, k);
        for (int i = 0; i < 20; ++i) {
          const Vec3d p = kernel.centre + Vec3d(unit(random), unit(random), unit(random));
          const double n = reference::density(std::span(&kernel, 1), p, k);
          EXPECT_NEAR(density_of(carried, lattice.local(carried_by(tree, p)), k), n,
                      3e-5 * static_cast<double>(kernel.weight));
        }
      }
    }
  }
}

TEST(PlacedKernels, AddUpToTheDensitiesOfTheTrees) {
  ForestLevel level;
  level.trees = kTrees;
  level.voxel_size = 0.1;
  level.reach = 3;
  ForestModel& model = level.models.emplace_back();
  model.kernels = model_kernels();
  for (const Kernel& k : model.kernels) {
    model.leaves.push_back({k.centre, k.normal, k.major, k.radius_major, k.radius_minor, 0});
  }
  const auto count = static_cast<std::uint32_t>(model.kernels.size());
  const std::vector<KernelRun> runs{{0, 0, count}, {1, 0, count}, {2, 0, count}};
  const Lattice lattice = Lattice::near(kTrees[0].position, level.voxel_size);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0, 2);
  for (const int k : {1, 2, 3}) {
    level.options.falloff = k;
    const KernelSet set = placed_kernels(
        level, runs, lattice,
        [](const ForestModel& of, std::size_t j, std::size_t) { return of.kernels[j]; });
    int above = 0;
    for (int i = 0; i < 300; ++i) {
      const Vec3d in_model(unit(random), unit(random), unit(random));
      const Vec3d p = carried_by(kTrees[static_cast<std::size_t>(i) % 3], in_model);
      double expected = 0, near = 0;
      for (const PlacedTree& tree : kTrees) {
        // Maps p back to the model; the columns of A give A^-1.
        const auto& m = tree.linear;
        const auto column = [&](int c) { return Vec3d(Vec3f(m[c], m[3 + c], m[6 + c])); };
        const Vec3d x = column(0), y = column(1), z = column(2), d = p - tree.position;
        const double volume = dot(x, cross(y, z));
        const Vec3d back =
            Vec3d(dot(d, cross(y, z)), dot(d, cross(z, x)), dot(d, cross(x, y))) * (1 / volume);
        expected += reference::density(model.kernels, back, k);
        near += reference::weight_near(model.kernels, back);
      }
      double n = 0;
      for (const LatticeKernel& kernel : set.kernels()) {
        n += density_of(kernel, lattice.local(p), k);
      }
      EXPECT_NEAR(n, expected, 1e-4 * near);
      above += expected > 0;
    }
    EXPECT_GT(above, 200);
  }
}

}  // namespace
}  // namespace leafhull
