// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "leafhull/shape.h"

namespace leafhull {

/// A mesh as web/viewer.js unpacks it: positions as steps from `low`, in a space where the frame
/// is centred on the origin and its longest side is 1. Both buffers are meshoptimizer's: vertices
/// of four 16-bit numbers, the last one zero, and 32-bit indices.
struct PackedMesh {
  std::size_t vertices = 0, triangles = 0;
  std::array<double, 3> low{};
  double step = 0;
  std::vector<std::uint8_t> vertex_buffer, index_buffer;
};

/// Meshes of more triangles than this are simplified: the rest would cost loading time unseen.
inline constexpr std::size_t kMostTriangles = 60'000;

/// `mesh` has vertices.
/// @param frame the box that pictures of several meshes share, not empty.
PackedMesh pack_mesh(const Mesh& mesh, const Box& frame);

}  // namespace leafhull
