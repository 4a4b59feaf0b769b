// SPDX-License-Identifier: Apache-2.0
#include "surface/components.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <tuple>

namespace leafhull {
namespace {

/// For each vertex the lowest vertex that it is connected to, whatever the order of the triangles:
/// of two trees that meet, the root of the higher one comes under the other's.
class Roots {
 public:
  explicit Roots(const Mesh& mesh) : parent_(mesh.positions.size()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t t) {
      const auto [a, b, c] = mesh.triangles[t];
      unite(a, b);
      unite(b, c);
    });
    tbb::parallel_for(0u, static_cast<std::uint32_t>(parent_.size()), [&](std::uint32_t v) {
      parent(v).store(find(v), std::memory_order_relaxed);
    });
  }
  std::uint32_t operator[](std::uint32_t v) const { return parent_[v]; }

 private:
  std::atomic_ref<std::uint32_t> parent(std::uint32_t v) { return std::atomic_ref(parent_[v]); }

  std::uint32_t find(std::uint32_t v) {
    for (;;) {
      std::uint32_t up = parent(v);
      const std::uint32_t next = parent(up);
      if (up == next) return up;
      parent(v).compare_exchange_weak(up, next);  // another thread may have gone further
      v = next;
    }
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    for (;;) {
      std::tie(a, b) = std::minmax({find(a), find(b)});
      if (a == b || parent(b).compare_exchange_strong(b, a)) return;
    }
  }

  std::vector<std::uint32_t> parent_;
};

/// The volume that each component encloses, times six, at its root vertex.
std::vector<double> volumes(const Mesh& mesh, const Roots& root) {
  std::vector<double> part(mesh.triangles.size());
  tbb::parallel_for(std::size_t{0}, part.size(), [&](std::size_t t) {
    const auto [a, b, c] = mesh.triangles[t];
    const Vec3d from(mesh.positions[root[a]]);
    const auto corner = [&](std::uint32_t v) { return Vec3d(mesh.positions[v]) - from; };
    part[t] = dot(corner(a), cross(corner(b), corner(c)));
  });
  std::vector<double> volume(mesh.positions.size(), 0.0);
  for (std::size_t t = 0; t < part.size(); ++t) volume[root[mesh.triangles[t][0]]] += part[t];
  for (double& v : volume) v = std::fabs(v);
  return volume;
}

}  // namespace

ComponentCount drop_small_components(Mesh& mesh, double smallest) {
  const Roots root(mesh);
  const std::vector<double> volume = volumes(mesh, root);
  const double least =
      volume.empty() ? 0 : smallest * *std::max_element(volume.begin(), volume.end());
  const auto stays = [&](std::uint32_t v) { return volume[root[v]] >= least; };

  ComponentCount count;
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (root[v] == v) ++(stays(v) ? count.kept : count.dropped);
  }
  if (count.dropped == 0) return count;

  std::vector<std::uint32_t> moved_to(vertices);
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (!stays(v)) continue;
    moved_to[v] = next;
    mesh.positions[next] = mesh.positions[v];
    mesh.normals[next] = mesh.normals[v];
    ++next;
  }
  mesh.positions.resize(next);
  mesh.normals.resize(next);
  std::erase_if(mesh.triangles, [&](const auto& triangle) { return !stays(triangle[0]); });
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t t) {
    for (std::uint32_t& v : mesh.triangles[t]) v = moved_to[v];
  });
  return count;
}

}  // namespace leafhull
