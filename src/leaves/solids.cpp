// SPDX-License-Identifier: Apache-2.0
#include "leaves/solids.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "leaves/union_find.h"

namespace leafhull {
namespace {

/// Cones over openings may have at most this share of the surface: a half sphere is a solid.
constexpr double kMostOpen = 0.55;

using Edge = std::pair<std::uint32_t, std::uint32_t>;  // the lesser first

struct Entry {
  std::array<std::uint32_t, 3> corners;  // ascending
  std::size_t face;
  auto operator<=>(const Entry&) const = default;
};

/// Keeps one of all faces with the same three corners: always if `once_each`, else only if their
/// number is odd.
std::vector<std::size_t> without_doubles(const std::vector<Entry>& entries, bool once_each) {
  std::vector<std::size_t> faces;
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin;
    while (end < entries.size() && entries[end].corners == entries[begin].corners) ++end;
    if (once_each || (end - begin) % 2 == 1) faces.push_back(entries[begin].face);
    begin = end;
  }
  std::ranges::sort(faces);
  return faces;
}

std::vector<std::size_t> faces_once(const LeafMesh& component) {
  std::vector<Entry> entries;
  for (std::size_t face = 0; face < component.triangles.size(); ++face) {
    auto corners = component.triangles[face];
    std::ranges::sort(corners);
    const bool is_line = corners[0] == corners[1] || corners[1] == corners[2];
    if (!is_line) entries.push_back({corners, face});
  }
  std::ranges::sort(entries);
  const std::vector<std::size_t> odd = without_doubles(entries, false);
  return odd.empty() ? without_doubles(entries, true) : odd;
}

/// The edges with an odd number of faces, in the direction of one of these faces.
std::vector<Edge> rim(const LeafMesh& component, const std::vector<std::size_t>& faces) {
  std::map<Edge, std::pair<std::size_t, Edge>> edges;
  for (const std::size_t face : faces) {
    const auto [a, b, c] = component.triangles[face];
    for (const Edge& edge : {Edge(a, b), Edge(b, c), Edge(c, a)}) {
      auto& [count, directed] = edges[std::minmax(edge.first, edge.second)];
      ++count;
      directed = edge;
    }
  }
  std::vector<Edge> odd;
  for (const auto& [ends, found] : edges) {
    if (found.first % 2 == 1) odd.push_back(found.second);
  }
  return odd;
}

/// The openings: connected edges of a rim.
std::vector<std::vector<Edge>> openings(const std::vector<Edge>& rim, std::size_t points) {
  UnionFind sets(points);
  for (const auto& [a, b] : rim) sets.unite(a, b);
  std::map<std::uint32_t, std::vector<Edge>> loops;
  for (const Edge& edge : rim) loops[sets.find(edge.first)].push_back(edge);
  std::vector<std::vector<Edge>> all;
  for (auto& [first, loop] : loops) all.push_back(std::move(loop));
  return all;
}

/// Flips as few faces as needed for neighbours to agree across edges that have two faces.
void turn_alike(std::vector<EigenTriangle>& surface) {
  const auto key = [](const Eigen::Vector3d& p) { return std::array{p.x(), p.y(), p.z()}; };
  using Point = std::array<double, 3>;
  struct Side {
    std::size_t face;
    bool ascends;  // along the edge, from the lesser end
  };
  std::map<std::pair<Point, Point>, std::vector<Side>> edges;
  for (std::size_t face = 0; face < surface.size(); ++face) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Point a = key(surface[face][i]), b = key(surface[face][(i + 1) % 3]);
      edges[std::minmax(a, b)].push_back({face, a < b});
    }
  }
  std::vector<std::vector<std::pair<std::size_t, bool>>> next(surface.size());  // whether it agrees
  for (const auto& [ends, sides] : edges) {
    if (sides.size() != 2) continue;
    const bool agrees = sides[0].ascends != sides[1].ascends;
    next[sides[0].face].emplace_back(sides[1].face, agrees);
    next[sides[1].face].emplace_back(sides[0].face, agrees);
  }
  std::vector<bool> seen(surface.size());
  const auto turn = [&](std::size_t face) { std::swap(surface[face][1], surface[face][2]); };
  for (std::size_t first = 0; first < surface.size(); ++first) {
    if (seen[first]) continue;
    std::vector<std::size_t> part{first};
    std::vector<bool> turned{false};
    seen[first] = true;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const std::size_t face = part[i];
      for (const auto& [other, agrees] : next[face]) {
        if (seen[other]) continue;
        seen[other] = true;
        part.push_back(other);
        turned.push_back(agrees == turned[i]);
      }
    }
    const bool minority = 2 * std::ranges::count(turned, true) <= std::ssize(turned);
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (turned[i] == minority) turn(part[i]);
    }
  }
}

double area_of(const EigenTriangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]).norm() / 2; }

}  // namespace

std::vector<EigenTriangle> closed_surface(const LeafMesh& component) {
  const std::vector<std::size_t> faces = faces_once(component);
  std::vector<EigenTriangle> surface;
  double own = 0, cones = 0;
  for (const std::size_t face : faces) {
    const auto [a, b, c] = component.triangles[face];
    surface.push_back({component.points[a], component.points[b], component.points[c]});
    own += area_of(surface.back());
  }
  for (const std::vector<Edge>& opening :
       openings(rim(component, faces), component.points.size())) {
    Eigen::Vector3d apex = Eigen::Vector3d::Zero();
    for (const auto& [a, b] : opening) apex += component.points[a] + component.points[b];
    apex /= 2 * static_cast<double>(opening.size());
    for (const auto& [a, b] : opening) {
      surface.push_back({component.points[b], component.points[a], apex});
      cones += area_of(surface.back());
    }
  }
  if (cones > kMostOpen * own) surface.clear();
  turn_alike(surface);
  return surface;
}

}  // namespace leafhull
