// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

#include "leafhull/shape.h"
#include "surface/brick_mesher.h"
#include "tiles/tile.h"
#include "unit/surface_test_fields.h"

namespace leafhull::test {

/// A ball, or a hole if the radius is negative.
struct Ball {
  Vec3d centre;
  double radius;
};

/// A closed mesh whose vertices know their cells and whose triangles know the lowest one around.
struct LatticeMesh {
  Mesh mesh;
  std::vector<Coord> cell;           ///< of each vertex
  std::vector<std::uint32_t> patch;  ///< of each vertex, its number in its cell
  std::vector<Coord> lowest;         ///< of each triangle
};

/// The mesh of balls and holes within [low, high), in 1 / 8192 voxels.
inline LatticeMesh mesh_of(const std::vector<Ball>& balls, Coord low, Coord high) {
  const auto density = [&](Vec3d p) {
    double highest = 0;
    for (const Ball& ball : balls) {
      const double distance = length(p - ball.centre);
      highest = ball.radius > 0 ? std::max(highest, 10 + ball.radius - distance)
                                : std::min(highest, 10 + ball.radius + distance);
    }
    return highest;
  };
  const Polygons polygons = mesh_bricks(field_of(density, 10, low, high));
  LatticeMesh result;
  std::map<Coord, std::uint32_t> patches;
  for (const Vec3f point : polygons.points) {
    result.cell.push_back(cell_of(Vec3d(point)));
    result.patch.push_back(patches[result.cell.back()]++);
    const auto rounded = [](float v) { return std::round(v * 8192) / 8192; };
    result.mesh.positions.push_back({rounded(point.x), rounded(point.y), rounded(point.z)});
    result.mesh.normals.push_back(Vec3f(normalized(Vec3d(point) + Vec3d{0.3, 0.2, 0.1})));
  }
  for (const auto& [a, b, c, d] : polygons.faces) {
    Coord lowest = result.cell[a];
    for (const std::uint32_t v : {b, c, d}) {
      const Coord cell = result.cell[v];
      lowest = {std::min(lowest.x, cell.x), std::min(lowest.y, cell.y), std::min(lowest.z, cell.z)};
    }
    result.mesh.triangles.push_back({a, b, c});
    result.lowest.push_back(lowest);
    if (c == d) continue;
    result.mesh.triangles.push_back({a, c, d});
    result.lowest.push_back(lowest);
  }
  return result;
}

inline Coord tile_of(Coord cell, int edge) {
  const auto at = [&](int v) { return static_cast<int>(std::floor(double(v) / edge)); };
  return {at(cell.x), at(cell.y), at(cell.z)};
}

inline bool is_lent(Coord cell, int edge) {
  const Coord tile = tile_of(cell, edge);
  return cell.x == tile.x * edge || cell.y == tile.y * edge || cell.z == tile.z * edge;
}

/// For each vertex, the vertex that represents its component.
inline std::vector<std::uint32_t> roots_of(const Mesh& mesh) {
  std::vector<std::uint32_t> root(mesh.positions.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v];
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const std::uint32_t v : {b, c}) {
      const auto [low, high] = std::minmax({find(a), find(v)});
      root[high] = low;
    }
  }
  for (std::uint32_t v = 0; v < root.size(); ++v) root[v] = find(v);
  return root;
}

/// Twelve times the volume under a triangle, in 1 / 2^39 voxels.
inline ExactVolume volume_under(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  std::array<std::array<std::int64_t, 3>, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d v = Vec3d(mesh.positions[triangle[i]]) * 8192.0;
    p[i] = {std::int64_t(v.x), std::int64_t(v.y), std::int64_t(v.z)};
  }
  const auto minor = [&](std::size_t i, std::size_t j) {
    return ExactVolume(p[1][i]) * p[2][j] - ExactVolume(p[1][j]) * p[2][i];
  };
  return 2 * (p[0][0] * minor(1, 2) + p[0][1] * minor(2, 0) + p[0][2] * minor(0, 1));
}

using Tiles = std::map<TileId, TileSurface>;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// The part of the mesh in one tile.
/// @param own       the vertices in the tile's cells
/// @param triangles the triangles whose lowest cell is in the tile
inline TileSurface cut_tile(const LatticeMesh& whole, int edge, Coord at,
                            const std::vector<std::uint32_t>& own, const Triangles& triangles) {
  std::set<std::tuple<Coord, std::uint32_t, std::uint32_t>> borrowed;
  for (const auto& triangle : triangles) {
    for (const std::uint32_t v : triangle) {
      if (tile_of(whole.cell[v], edge) != at) borrowed.insert({whole.cell[v], whole.patch[v], v});
    }
  }

  TileSurface tile;
  std::map<std::uint32_t, std::uint32_t> index;
  const auto add = [&](std::uint32_t v) {
    index[v] = static_cast<std::uint32_t>(tile.mesh.positions.size());
    tile.mesh.positions.push_back(whole.mesh.positions[v]);
    tile.mesh.normals.push_back(whole.mesh.normals[v]);
  };
  for (const std::uint32_t v : own) add(v);
  for (const auto& [cell, patch, v] : borrowed) add(v);
  for (const auto& [a, b, c] : triangles) {
    tile.mesh.triangles.push_back({index[a], index[b], index[c]});
  }
  tile.own_vertices = static_cast<std::uint32_t>(own.size());

  const std::vector<std::uint32_t> root = roots_of(tile.mesh);
  std::map<std::uint32_t, std::uint32_t> component;
  const auto seam_vertex = [&](std::uint32_t v) {
    const auto [found, is_new] =
        component.try_emplace(root[index[v]], static_cast<std::uint32_t>(component.size()));
    if (is_new) tile.components.push_back({.vertex = index[v], .volume = 0});
    return SeamVertex{whole.cell[v], whole.patch[v], index[v], found->second};
  };
  for (const auto& [cell, patch, v] : borrowed) tile.borrowed.push_back(seam_vertex(v));
  for (const std::uint32_t v : own) {
    if (is_lent(whole.cell[v], edge)) tile.lent.push_back(seam_vertex(v));
  }
  std::sort(tile.lent.begin(), tile.lent.end());
  for (const auto& triangle : tile.mesh.triangles) {
    const auto found = component.find(root[triangle[0]]);
    if (found == component.end()) continue;
    tile.components[found->second].volume += volume_under(tile.mesh, triangle);
  }
  return tile;
}

/// Every tile that is not empty, and the tile above each.
inline Tiles cut(const LatticeMesh& whole, int edge, int level = 0) {
  std::map<Coord, std::vector<std::uint32_t>> own;
  std::map<Coord, Triangles> triangles;
  for (std::uint32_t v = 0; v < whole.cell.size(); ++v) {
    own[tile_of(whole.cell[v], edge)].push_back(v);
  }
  for (std::size_t t = 0; t < whole.lowest.size(); ++t) {
    triangles[tile_of(whole.lowest[t], edge)].push_back(whole.mesh.triangles[t]);
  }
  std::set<Coord> all;
  for (const auto& [at, vertices] : own) all.insert({at, at + Coord{0, 0, 1}});
  for (const auto& [at, vertices] : triangles) all.insert(at);
  Tiles tiles;
  for (const Coord at : all) {
    tiles[{level, at}] = cut_tile(whole, edge, at, own[at], triangles[at]);
  }
  return tiles;
}

/// The mesh of all tiles, in their order, without pieces that reach a seam and have a volume below
/// `least`.
struct Welded {
  Mesh mesh;
  std::size_t dropped = 0;  ///< number of pieces
};
inline Welded expected_weld(const LatticeMesh& whole, int edge, ExactVolume least) {
  const std::vector<std::uint32_t> root = roots_of(whole.mesh);
  std::map<std::uint32_t, ExactVolume> volume;
  std::set<std::uint32_t> reaches_seam;
  for (const auto& triangle : whole.mesh.triangles) {
    volume[root[triangle[0]]] += volume_under(whole.mesh, triangle);
  }
  for (std::uint32_t v = 0; v < root.size(); ++v) {
    if (is_lent(whole.cell[v], edge)) reaches_seam.insert(root[v]);
  }
  const auto goes = [&](std::uint32_t v) {
    const ExactVolume size = volume[root[v]];
    return reaches_seam.contains(root[v]) && (size < 0 ? -size : size) < least;
  };

  Welded welded;
  std::set<std::uint32_t> dropped;
  std::vector<std::uint32_t> order(root.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return tile_of(whole.cell[a], edge) < tile_of(whole.cell[b], edge);
  });
  std::vector<std::uint32_t> moved_to(root.size());
  for (const std::uint32_t v : order) {
    if (goes(v)) {
      dropped.insert(root[v]);
      continue;
    }
    moved_to[v] = static_cast<std::uint32_t>(welded.mesh.positions.size());
    welded.mesh.positions.push_back(whole.mesh.positions[v]);
    welded.mesh.normals.push_back(whole.mesh.normals[v]);
  }
  welded.dropped = dropped.size();
  std::vector<std::size_t> faces(whole.lowest.size());
  std::iota(faces.begin(), faces.end(), std::size_t{0});
  std::stable_sort(faces.begin(), faces.end(), [&](std::size_t a, std::size_t b) {
    return tile_of(whole.lowest[a], edge) < tile_of(whole.lowest[b], edge);
  });
  for (const std::size_t f : faces) {
    const auto& [a, b, c] = whole.mesh.triangles[f];
    if (!goes(a)) welded.mesh.triangles.push_back({moved_to[a], moved_to[b], moved_to[c]});
  }
  return welded;
}

/// The number of directed edges without an edge the other way.
inline std::size_t open_edges(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
      ++count[{from, to}];
      --count[{to, from}];
    }
  }
  std::size_t open = 0;
  for (const auto& [edge, excess] : count) open += excess != 0;
  return open;
}

}  // namespace leafhull::test
