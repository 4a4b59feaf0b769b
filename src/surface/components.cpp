// SPDX-License-Identifier: Apache-2.0
#include "surface/components.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace leafhull {
namespace {

/// For each vertex the lowest vertex that it is connected to.
std::vector<std::uint32_t> roots_of(const Mesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& triangle : mesh.triangles) {
    for (int e = 0; e < 2; ++e) {
      const std::uint32_t a = find(triangle[e]), b = find(triangle[e + 1]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::uint32_t v = 0; v < parent.size(); ++v) parent[v] = find(v);
  return parent;
}

/// Six times the volume that each component encloses, at its root vertex.
std::vector<double> volumes(const Mesh& mesh, const std::vector<std::uint32_t>& root) {
  std::vector<double> volume(mesh.positions.size(), 0.0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d from(mesh.positions[root[a]]);
    const auto corner = [&](std::uint32_t v) { return Vec3d(mesh.positions[v]) - from; };
    volume[root[a]] += dot(corner(a), cross(corner(b), corner(c)));
  }
  for (double& v : volume) v = std::fabs(v);
  return volume;
}

}  // namespace

ComponentCount drop_small_components(Mesh& mesh, double smallest) {
  const std::vector<std::uint32_t> root = roots_of(mesh);
  const std::vector<double> volume = volumes(mesh, root);
  const double least =
      volume.empty() ? 0 : smallest * *std::max_element(volume.begin(), volume.end());
  const auto stays = [&](std::uint32_t v) { return volume[root[v]] >= least; };

  ComponentCount count;
  std::vector<std::uint32_t> moved_to(root.size());
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < root.size(); ++v) {
    if (root[v] == v) ++(stays(v) ? count.kept : count.dropped);
    if (!stays(v)) continue;
    moved_to[v] = next;
    mesh.positions[next] = mesh.positions[v];
    mesh.normals[next] = mesh.normals[v];
    ++next;
  }
  if (count.dropped == 0) return count;
  mesh.positions.resize(next);
  mesh.normals.resize(next);
  std::erase_if(mesh.triangles, [&](const auto& triangle) { return !stays(triangle[0]); });
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& v : triangle) v = moved_to[v];
  }
  return count;
}

}  // namespace leafhull
