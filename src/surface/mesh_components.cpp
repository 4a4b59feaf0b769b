// SPDX-License-Identifier: Apache-2.0
#include "surface/mesh_components.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "surface/disjoint_sets.h"

namespace leafhull {
namespace {

/// For each vertex the lowest one that it is connected to.
using Roots = std::vector<std::uint32_t>;

Roots roots_of(const Polygons& polygons) {
  DisjointSets sets(polygons.points.size());
  tbb::parallel_for(std::size_t{0}, polygons.faces.size(), [&](std::size_t f) {
    const auto [a, b, c, d] = polygons.faces[f];
    sets.unite(a, b);
    sets.unite(b, c);
    sets.unite(c, d);
  });
  return std::move(sets).lowest();
}

/// Twelve times the volume that each component encloses, stored at its root vertex; negative for a
/// hollow. A quad counts as the mean of its two foldings, so its first corner does not matter.
std::vector<double> volumes(const Polygons& polygons, const Roots& root) {
  std::vector<double> part(polygons.faces.size());
  tbb::parallel_for(std::size_t{0}, part.size(), [&](std::size_t f) {
    const auto [a, b, c, d] = polygons.faces[f];
    const Vec3d from(polygons.points[root[a]]);
    const auto corner = [&](std::uint32_t v) { return Vec3d(polygons.points[v]) - from; };
    const Vec3d p = corner(a), q = corner(b), r = corner(c), s = corner(d);
    part[f] = dot(p, cross(q, r) + cross(r, s) + cross(q, s)) + dot(q, cross(r, s));
  });
  std::vector<double> volume(polygons.points.size(), 0.0);
  for (std::size_t f = 0; f < part.size(); ++f) volume[root[polygons.faces[f][0]]] += part[f];
  return volume;
}

/// Which components are large enough.
class Components {
 public:
  Components(const Polygons& polygons, double smallest)
      : root_(roots_of(polygons)), volume_(volumes(polygons, root_)) {
    if (!volume_.empty()) {
      for (const double v : volume_) least_ = std::max(least_, smallest * std::fabs(v));
    }
  }
  bool is_root(std::uint32_t v) const { return root_[v] == v; }
  bool stays(std::uint32_t v) const { return std::fabs(volume_[root_[v]]) >= least_; }
  bool is_hollow(std::uint32_t v) const { return volume_[root_[v]] < 0; }

 private:
  Roots root_;
  std::vector<double> volume_;
  double least_ = 0;
};

}  // namespace

std::vector<std::uint32_t> component_of_each(const Polygons& polygons) {
  return roots_of(polygons);
}

ComponentCells cells_of_components(const Polygons& polygons, double smallest) {
  const Components components(polygons, smallest);
  ComponentCells cells;
  for (std::uint32_t v = 0; v < polygons.points.size(); ++v) {
    const Coord cell = cell_of(Vec3d(polygons.points[v]));
    (components.stays(v) ? cells.kept : cells.dropped).push_back(cell);
  }
  return cells;
}

ComponentCount drop_small_components(Polygons& polygons, double smallest) {
  const Components components(polygons, smallest);
  const auto stays = [&](std::uint32_t v) { return components.stays(v); };
  ComponentCount count;
  const auto vertices = static_cast<std::uint32_t>(polygons.points.size());
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (components.is_root(v)) ++(stays(v) ? count.kept : count.dropped);
  }
  if (count.dropped == 0) return count;

  std::vector<std::uint32_t> moved_to(vertices);
  std::uint32_t next = 0;
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (!stays(v)) {
      if (!components.is_hollow(v)) {
        count.dropped_cells.push_back(cell_of(Vec3d(polygons.points[v])));
      }
      continue;
    }
    moved_to[v] = next;
    polygons.points[next] = polygons.points[v];
    ++next;
  }
  std::ranges::sort(count.dropped_cells);
  const auto repeated = std::ranges::unique(count.dropped_cells);
  count.dropped_cells.erase(repeated.begin(), repeated.end());
  polygons.points.resize(next);
  std::erase_if(polygons.faces, [&](const auto& face) { return !stays(face[0]); });
  tbb::parallel_for(std::size_t{0}, polygons.faces.size(), [&](std::size_t f) {
    for (std::uint32_t& v : polygons.faces[f]) v = moved_to[v];
  });
  return count;
}

}  // namespace leafhull
