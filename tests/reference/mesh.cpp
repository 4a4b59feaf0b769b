// SPDX-License-Identifier: Apache-2.0
#include "mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace recount {
namespace {

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Point& a) { return std::sqrt(dot(a, a)); }

std::size_t count_unmatched_edges(const Ply& mesh) {
  std::vector<std::uint64_t> edges;
  const auto edge = [](std::uint64_t from, std::uint64_t to) { return from << 32 | to; };
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) edges.push_back(edge(t[i], t[(i + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  const auto uses = [&](std::uint64_t e) {
    const auto [first, last] = std::equal_range(edges.begin(), edges.end(), e);
    return last - first;
  };
  return std::size_t(std::count_if(edges.begin(), edges.end(), [&](std::uint64_t e) {
    const std::uint64_t from = e >> 32, to = e & 0xffffffff;
    return from == to || uses(e) != 1 || uses(edge(to, from)) != 1;
  }));
}

std::size_t count_unused_vertices(const Ply& mesh) {
  std::vector<bool> used(mesh.vertex_count);
  for (const auto& triangle : mesh.triangles) {
    for (std::uint32_t vertex : triangle) used[vertex] = true;
  }
  return std::size_t(std::count(used.begin(), used.end(), false));
}

/// For each vertex, the vertex that represents its component.
std::vector<std::uint32_t> component_of_vertices(const Ply& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertex_count);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& t : mesh.triangles) {
    parent[root(t[1])] = root(t[0]);
    parent[root(t[2])] = root(t[0]);
  }
  for (std::uint32_t v = 0; v < parent.size(); ++v) parent[v] = root(v);
  return parent;
}

void examine_triangles(const Ply& mesh, const std::vector<Point>& positions,
                       const std::vector<Density>& densities, double near, double smallest,
                       MeshFacts& facts) {
  const std::vector<std::uint32_t> component = component_of_vertices(mesh);
  struct Component {
    double volume = 0, outwardness = 0;
  };
  std::map<std::uint32_t, Component> components;
  for (const auto& t : mesh.triangles) {
    Component& own = components[component[t[0]]];
    const Point& from = positions[component[t[0]]];
    const Point a = positions[t[0]] - from, b = positions[t[1]] - from, c = positions[t[2]] - from;
    own.volume += dot(a, cross(b, c)) / 6;
    const Point area = cross(b - a, c - a);
    for (std::uint32_t vertex : t) {
      const Point& gradient = densities[vertex].gradient;
      const double steepness = length(gradient);
      if (steepness > 0 && facts.distances[vertex] <= near)
        own.outwardness -= dot(area, gradient) / steepness;
    }
  }
  facts.components = components.size();
  for (const auto& [root, own] : components) {
    facts.volume += own.volume;
    facts.inward_components += own.volume < -smallest && own.outwardness < 0;
  }
}

}  // namespace

MeshFacts examine(const Ply& mesh, const std::vector<Density>& densities, double threshold,
                  double near, double smallest) {
  const std::vector<Point> positions = mesh.points("x", "y", "z");
  const std::vector<Point> normals = mesh.points("nx", "ny", "nz");
  MeshFacts facts;
  facts.unmatched_edges = count_unmatched_edges(mesh);
  facts.unused_vertices = count_unused_vertices(mesh);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto& [value, gradient] = densities[i];
    const double error = std::abs(value - threshold);
    facts.distances.push_back(error == 0 ? 0 : error / length(gradient));
    const Point outward = Point{} - gradient;
    const double angle = std::atan2(length(cross(normals[i], outward)), dot(normals[i], outward));
    facts.normal_angles.push_back(angle * 180 / M_PI);
  }
  examine_triangles(mesh, positions, densities, near, smallest, facts);
  return facts;
}

double percentile(std::vector<double> values, double f) {
  if (values.empty()) return HUGE_VAL;
  const std::size_t rank = std::size_t(std::max(1.0, std::ceil(f * double(values.size())))) - 1;
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank), values.end());
  return values[rank];
}

}  // namespace recount
