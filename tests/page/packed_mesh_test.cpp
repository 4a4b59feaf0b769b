// SPDX-License-Identifier: Apache-2.0
#include "page/packed_mesh.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>

#include "unit/output_sample.h"

namespace leafhull::test {
namespace {

struct Unpacked {
  std::vector<Vec3d> positions;
  std::vector<std::uint32_t> indices;
};

Unpacked unpack(const PackedMesh& mesh) {
  std::vector<std::array<std::uint16_t, 4>> steps(mesh.vertices);
  EXPECT_EQ(meshopt_decodeVertexBuffer(steps.data(), steps.size(), sizeof steps.front(),
                                       mesh.vertex_buffer.data(), mesh.vertex_buffer.size()),
            0);
  Unpacked unpacked;
  unpacked.indices.resize(3 * mesh.triangles);
  EXPECT_EQ(meshopt_decodeIndexBuffer(unpacked.indices.data(), unpacked.indices.size(),
                                      mesh.index_buffer.data(), mesh.index_buffer.size()),
            0);
  for (const auto& step : steps) {
    unpacked.positions.push_back(Vec3d(mesh.low[0], mesh.low[1], mesh.low[2]) +
                                 Vec3d(step[0], step[1], step[2]) * mesh.step);
  }
  return unpacked;
}

/// Six times the enclosed volume; positive if the faces look outward.
double volume6(const std::vector<Vec3d>& positions, const std::vector<std::uint32_t>& indices) {
  double sum = 0;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    sum += dot(positions[indices[i]], cross(positions[indices[i + 1]], positions[indices[i + 2]]));
  }
  return sum;
}

TEST(PackedMesh, LiesInAFrameOfLongestSideOne) {
  Mesh mesh = sphere(20);  // the radius is 2
  mesh.origin = {1000, 0, 0};
  Box frame;
  frame.include({996, -1, -1});
  frame.include({1004, 1, 1});
  const PackedMesh packed = pack_mesh(mesh, frame);
  const Unpacked unpacked = unpack(packed);
  ASSERT_EQ(unpacked.positions.size(), mesh.positions.size());
  EXPECT_EQ(packed.triangles, mesh.triangles.size());
  for (const Vec3d& position : unpacked.positions) {
    EXPECT_NEAR(length(position), 0.25, 2 * packed.step);
  }
  EXPECT_LT(packed.step, 1e-4);

  std::vector<Vec3d> positions;
  for (const Vec3f& position : mesh.positions) positions.push_back(Vec3d(position) / 8.0);
  std::vector<std::uint32_t> indices;
  for (const auto& triangle : mesh.triangles) {
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  }
  EXPECT_NEAR(volume6(unpacked.positions, unpacked.indices), volume6(positions, indices), 1e-3);
}

TEST(PackedMesh, SimplifiesWhatWouldNotBeSeen) {
  const Mesh mesh = sphere(300);
  ASSERT_GT(mesh.triangles.size(), 2 * kMostTriangles);
  Box frame;
  frame.include({-2, -2, -2});
  frame.include({2, 2, 2});
  const PackedMesh packed = pack_mesh(mesh, frame);
  EXPECT_LE(packed.triangles, kMostTriangles);
  EXPECT_GT(packed.triangles, kMostTriangles / 2);
  EXPECT_LT(packed.vertex_buffer.size() + packed.index_buffer.size(), 200'000u);
  const Unpacked unpacked = unpack(packed);
  for (const Vec3d& position : unpacked.positions) EXPECT_NEAR(length(position), 0.5, 1e-3);
}

}  // namespace
}  // namespace leafhull::test
