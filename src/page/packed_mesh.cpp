// SPDX-License-Identifier: Apache-2.0
#include "page/packed_mesh.h"

#include <meshoptimizer.h>

#include <cmath>
#include <cstddef>

namespace leafhull {
namespace {

// A shape of 64 voxels then has about 200 steps per voxel.
constexpr double kSteps = 16'383;

struct PackedVertex {
  std::uint16_t x, y, z, unused = 0;
};

std::vector<std::uint32_t> triangles_for_view(const Mesh& mesh) {
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  }
  if (mesh.triangles.size() > kMostTriangles) {
    constexpr float kMostError = 1;  // the mesh's size: only the number of triangles decides
    indices.resize(meshopt_simplify(indices.data(), indices.data(), indices.size(),
                                    &mesh.positions.front().x, mesh.positions.size(), sizeof(Vec3f),
                                    3 * kMostTriangles, kMostError));
  }
  return indices;
}

/// Puts vertices in the order in which `indices` first use them, and drops unused ones.
std::vector<Vec3f> order_for_compression(const Mesh& mesh, std::vector<std::uint32_t>& indices) {
  meshopt_optimizeVertexCacheStrip(indices.data(), indices.data(), indices.size(),
                                   mesh.positions.size());
  std::vector<Vec3f> positions(mesh.positions.size());
  positions.resize(meshopt_optimizeVertexFetch(positions.data(), indices.data(), indices.size(),
                                               mesh.positions.data(), mesh.positions.size(),
                                               sizeof(Vec3f)));
  return positions;
}

std::vector<std::uint8_t> encode_vertices(const std::vector<PackedVertex>& vertices) {
  std::vector<std::uint8_t> bytes(
      meshopt_encodeVertexBufferBound(vertices.size(), sizeof(PackedVertex)));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices.data(),
                                          vertices.size(), sizeof(PackedVertex)));
  return bytes;
}

std::vector<std::uint8_t> encode_indices(const std::vector<std::uint32_t>& indices,
                                         std::size_t vertices) {
  std::vector<std::uint8_t> bytes(meshopt_encodeIndexBufferBound(indices.size(), vertices));
  bytes.resize(
      meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), indices.size()));
  return bytes;
}

}  // namespace

PackedMesh pack_mesh(const Mesh& mesh, const Box& frame) {
  std::vector<std::uint32_t> indices = triangles_for_view(mesh);
  const std::vector<Vec3f> positions = order_for_compression(mesh, indices);

  Box box;
  for (const Vec3f& position : positions) box.include(Vec3d(position));
  const double side = box.longest_side(), frame_side = frame.longest_side();
  const double steps_per_unit = side > 0 ? kSteps / side : 0;

  std::vector<PackedVertex> vertices;
  vertices.reserve(positions.size());
  const auto steps = [](double distance) {
    return static_cast<std::uint16_t>(std::lround(distance));
  };
  for (const Vec3f& position : positions) {
    const Vec3d at = (Vec3d(position) - box.low) * steps_per_unit;
    vertices.push_back({steps(at.x), steps(at.y), steps(at.z)});
  }

  const Vec3d low = (mesh.origin + box.low - (frame.low + frame.high) / 2.0) / frame_side;
  return {.vertices = vertices.size(),
          .triangles = indices.size() / 3,
          .low = {low.x, low.y, low.z},
          .step = side / kSteps / frame_side,
          .vertex_buffer = encode_vertices(vertices),
          .index_buffer = encode_indices(indices, vertices.size())};
}

}  // namespace leafhull
