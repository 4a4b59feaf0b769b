// SPDX-License-Identifier: Apache-2.0
#include "bench/marching_cubes.h"

#include <limits>

namespace leafhull::bench::published {
namespace {

// A cell's corner is a number of three bits, x y z from the highest. An edge runs along `axis` from
// `corner`, whose bit there is zero, and has the number 8 * axis + corner.
constexpr int kEdges = 24;

constexpr int bit(int axis) { return 4 >> axis; }

int edge_between(int a, int b) {
  const int axis = (a ^ b) == 4 ? 0 : (a ^ b) == 2 ? 1 : 2;
  return 8 * axis + (a & b);
}

/// The corners of a face, counter-clockwise seen from outside the cell.
std::array<int, 4> corners_of_face(int axis, bool far) {
  const int base = far ? bit(axis) : 0;
  const int u = bit((axis + 1) % 3), v = bit((axis + 2) % 3);
  if (far) return {base, base | u, base | u | v, base | v};
  return {base, base | v, base | u | v, base | u};
}

/// The triangles of each of the 256 cases, as edges. Around every face runs of corners inside are
/// cut off, from the edge that enters a run to the one that leaves it; an edge with a crossing
/// enters on one of its two faces and leaves on the other, so these cuts join into loops.
using Case = std::vector<std::array<int, 3>>;

Case triangles_of(int inside) {
  const auto is_inside = [&](int corner) { return (inside >> corner & 1) != 0; };
  std::array<int, kEdges> next;
  next.fill(-1);
  for (int face = 0; face < 6; ++face) {
    const std::array<int, 4> corner = corners_of_face(face / 2, face % 2 != 0);
    for (int i = 0; i < 4; ++i) {
      if (!is_inside(corner[i]) || is_inside(corner[(i + 1) % 4])) continue;
      int first = i;  // the start of the run of corners inside that ends at i
      while (is_inside(corner[(first + 3) % 4])) first = (first + 3) % 4;
      next[edge_between(corner[(first + 3) % 4], corner[first])] =
          edge_between(corner[i], corner[(i + 1) % 4]);
    }
  }
  Case triangles;
  for (int start = 0; start < kEdges; ++start) {
    if (next[start] < 0) continue;
    int b = next[start];
    for (int c = next[b]; c != start; c = next[c]) {
      triangles.push_back({start, b, c});
      next[b] = -1;
      b = c;
    }
    next[b] = next[start] = -1;
  }
  return triangles;
}

std::array<Case, 256> make_cases() {
  std::array<Case, 256> cases;
  for (int i = 0; i < 256; ++i) cases[i] = triangles_of(i);
  return cases;
}

class Polygoniser {
 public:
  Polygoniser(const Grid& grid, double threshold)
      : grid_(grid), threshold_(threshold), vertex_(3 * grid.values.size(), kNone) {}

  TriangleMesh run() {
    static const std::array<Case, 256> kCases = make_cases();
    const auto [nx, ny, nz] = grid_.count;
    for (std::size_t x = 0; x + 1 < nx; ++x) {
      for (std::size_t y = 0; y + 1 < ny; ++y) {
        for (std::size_t z = 0; z + 1 < nz; ++z) {
          for (const auto& [a, b, c] : kCases[case_of(x, y, z)]) {
            const std::uint32_t va = vertex_on(x, y, z, a), vb = vertex_on(x, y, z, b),
                                vc = vertex_on(x, y, z, c);
            mesh_.triangles.push_back({va, vb, vc});
          }
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::size_t corner(std::size_t x, std::size_t y, std::size_t z, int c) const {
    return grid_.index(x + (c >> 2 & 1), y + (c >> 1 & 1), z + (c & 1));
  }

  int case_of(std::size_t x, std::size_t y, std::size_t z) const {
    int inside = 0;
    for (int c = 0; c < 8; ++c) {
      inside |= (grid_.values[corner(x, y, z, c)] >= threshold_ ? 1 : 0) << c;
    }
    return inside;
  }

  /// The vertex on an edge of a cell, shared with the cells around it.
  std::uint32_t vertex_on(std::size_t x, std::size_t y, std::size_t z, int edge) {
    const int axis = edge / 8, c = edge % 8;
    const std::size_t from = corner(x, y, z, c), to = corner(x, y, z, c | bit(axis));
    std::uint32_t& vertex = vertex_[3 * from + static_cast<std::size_t>(axis)];
    if (vertex != kNone) return vertex;
    vertex = static_cast<std::uint32_t>(mesh_.positions.size());
    const double t = (threshold_ - grid_.values[from]) / (grid_.values[to] - grid_.values[from]);
    const auto coordinate = [&](int a, std::size_t cell) {
      const std::size_t lattice = cell + ((c & bit(a)) != 0 ? 1 : 0);
      return (static_cast<double>(grid_.low[a]) + static_cast<double>(lattice) +
              (a == axis ? t : 0)) *
             grid_.voxel;
    };
    mesh_.positions.emplace_back(coordinate(0, x), coordinate(1, y), coordinate(2, z));
    return vertex;
  }

  const Grid& grid_;
  double threshold_;
  std::vector<std::uint32_t> vertex_;  // on the three edges that begin at each corner
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh marching_cubes(const Grid& grid, double threshold) {
  return Polygoniser(grid, threshold).run();
}

}  // namespace leafhull::bench::published
