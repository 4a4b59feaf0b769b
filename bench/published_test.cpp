// SPDX-License-Identifier: Apache-2.0
// The published algorithm does leafhull's work: the same density at every sample, a closed surface.
#include "bench/published.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "bench/leafhull_case.h"
#include "leafhull/shape.h"
#include "surface/density_grid.h"

namespace leafhull::bench {
namespace {

using published::Grid;
using published::TriangleMesh;

Grid grid_of(std::size_t count, const std::function<double(Vec3d)>& value) {
  Grid grid{.low = {-5, 0, 7}, .count = {count, count, count}, .voxel = 0.5, .values = {}};
  for (std::size_t x = 0; x < count; ++x) {
    for (std::size_t y = 0; y < count; ++y) {
      for (std::size_t z = 0; z < count; ++z) {
        grid.values.push_back(value(Vec3d(Vec3<std::size_t>(x, y, z))));
      }
    }
  }
  return grid;
}

/// Every directed edge occurs as often as its opposite: once, but where diagonals of two cells meet
/// on a face between them.
void expect_closed(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    const auto opposite = edges.find({edge.second, edge.first});
    ASSERT_NE(opposite, edges.end());
    ASSERT_EQ(count, opposite->second);
  }
}

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += dot(mesh.positions[a], cross(mesh.positions[b], mesh.positions[c])) / 6;
  }
  return sum;
}

TEST(MarchingCubes, BallHasItsVolumeOutwards) {
  const Vec3d centre(9.6, 10.1, 9.8);
  const double radius = 7.3;
  const TriangleMesh mesh =
      marching_cubes(grid_of(21, [&](Vec3d p) { return radius - length(p - centre); }), 0);
  expect_closed(mesh);
  const double exact = 4.0 / 3 * std::numbers::pi * std::pow(radius * 0.5, 3);
  EXPECT_LT(volume(mesh), exact);  // chords lie inside
  EXPECT_GT(volume(mesh), 0.98 * exact);
  for (const Vec3d p : mesh.positions) {
    const Vec3d local = p / 0.5 - Vec3d(-5, 0, 7);
    EXPECT_NEAR(length(local - centre), radius, 0.02);
  }
}

TEST(MarchingCubes, EveryCaseClosesWithItsNeighbours) {
  std::mt19937 random(1);
  const auto noise = [&](Vec3d p) {
    const bool border = std::min({p.x, p.y, p.z}) == 0 || std::max({p.x, p.y, p.z}) == 19;
    return border ? 0.0 : static_cast<double>(random()) * 0x1p-32;
  };
  const TriangleMesh mesh = marching_cubes(grid_of(20, noise), 0.5);
  EXPECT_GT(mesh.triangles.size(), 10000u);
  expect_closed(mesh);
}

class PublishedField : public testing::TestWithParam<Method> {};

TEST_P(PublishedField, IsLeafhulls) {
  const LeafSet leaves = load_leaves(LEAFHULL_EXAMPLES "/ash.glb");
  Options options;
  options.method = GetParam();
  options.resolution = 32;
  options.points = PointSource::vertices;
  options.threshold = 4;
  options.density = DensitySource::grid;  // as step 2 says it
  Device device{{}};
  const Shape shape = extract(leaves, options, device);

  std::vector<published::Leaf> published_leaves;
  for (const LeafVertex& v : leaves.vertices) {
    published_leaves.push_back(
        {v.position, Vec3d(v.normal), Vec3d(v.major), v.radius_major, v.radius_minor});
  }
  const Grid grid =
      published::density_field(published_leaves, {.radius_max = shape.report.radius_max_model,
                                                  .voxel = shape.report.voxel_size,
                                                  .flatness = *shape.report.options.flatness,
                                                  .controlled = GetParam() == Method::controlled});
  const auto samples = density_grid(*shape.field);
  ASSERT_GT(samples->activeVoxelCount(), 1000u);
  for (auto sample = samples->cbeginValueOn(); sample; ++sample) {
    ASSERT_TRUE(sample.isVoxelValue());
    std::array<std::size_t, 3> at;
    bool in_grid = true;
    for (int a = 0; a < 3; ++a) {
      const std::int64_t i = sample.getCoord()[a] - grid.low[a];
      in_grid = in_grid && i >= 0 && i < static_cast<std::int64_t>(grid.count[a]);
      at[a] = static_cast<std::size_t>(i);
    }
    const double exact = in_grid ? grid.values[grid.index(at[0], at[1], at[2])] : 0;
    ASSERT_NEAR(*sample, exact, 1e-4 * std::max(1.0, exact)) << sample.getCoord();
  }
}

INSTANTIATE_TEST_SUITE_P(, PublishedField, testing::Values(Method::isotropic, Method::controlled),
                         [](const auto& method) { return std::string(name(method.param)); });

TEST(LiteralField, IsTheSame) {
  std::vector<published::Leaf> leaves;
  for (const LeafVertex& v : load_leaves("synthetic:400").vertices) {
    leaves.push_back({v.position, Vec3d(v.normal), Vec3d(v.major), v.radius_major, v.radius_minor});
  }
  published::Parameters parameters{.radius_max = 0.2, .voxel = 0.06, .flatness = 0.8};
  const Grid gathered = published::density_field(leaves, parameters);
  parameters.literal = true;
  const Grid literal = published::density_field(leaves, parameters);
  ASSERT_EQ(gathered.count, literal.count);
  for (std::size_t i = 0; i < literal.values.size(); ++i) {
    ASSERT_NEAR(gathered.values[i], literal.values[i], 1e-12);
  }
}

}  // namespace
}  // namespace leafhull::bench
