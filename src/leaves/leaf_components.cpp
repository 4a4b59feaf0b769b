// SPDX-License-Identifier: Apache-2.0
#include "leaves/leaf_components.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

#include "leaves/leaf_mesh.h"
#include "leaves/union_find.h"

namespace leafhull {
namespace {

// Just below cos 45 degrees: an edge of exactly 45 degrees is not cut, whatever the rounding.
constexpr double kCosSharp = 0.7071;
// Two faces this close to lying on each other are the front and the back of one sheet.
constexpr double kCosDoubled = 0.9999;

Face least_rotation(const Face& face) {
  Face least = face;
  Face turned = face;
  for (int turn = 0; turn < 2; ++turn) {
    std::ranges::rotate(turned.position, turned.position.begin() + 1);
    std::ranges::rotate(turned.vertex, turned.vertex.begin() + 1);
    if (turned.position < least.position) least = turned;
  }
  return least;
}

/// An edge as one of its faces sees it.
struct EdgeSide {
  std::pair<std::uint32_t, std::uint32_t> ends;  ///< into LeafMesh::points, the lesser first
  std::uint32_t face;
  std::uint32_t corner;  ///< of the face, where the edge starts
};

/// The three sides of every face that has an area; sides of the same edge are adjacent.
std::vector<EdgeSide> edge_sides(const LeafMesh& leaf) {
  std::vector<EdgeSide> sides;
  sides.reserve(3 * leaf.faces.size());
  for (std::uint32_t face = 0; face < leaf.faces.size(); ++face) {
    if (leaf.areas[face].isZero(0)) continue;
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = leaf.triangles[face][corner];
      const std::uint32_t b = leaf.triangles[face][(corner + 1) % 3];
      sides.push_back({std::minmax(a, b), face, corner});
    }
  }
  std::ranges::sort(sides, {}, &EdgeSide::ends);
  return sides;
}

/// The unit vector in the face that leaves the edge at right angles.
Eigen::Vector3d inward(const LeafMesh& leaf, const EdgeSide& side) {
  const auto& triangle = leaf.triangles[side.face];
  const Eigen::Vector3d& start = leaf.points[triangle[side.corner]];
  const Eigen::Vector3d edge = leaf.points[triangle[(side.corner + 1) % 3]] - start;
  const Eigen::Vector3d across = leaf.points[triangle[(side.corner + 2) % 3]] - start;
  return edge.cross(across).cross(edge).normalized();
}

/// Whether a sheet continues from one face to the other, or turns back as its other side.
bool is_smooth(const LeafMesh& leaf, const EdgeSide& a, const EdgeSide& b) {
  const double cosine = inward(leaf, a).dot(inward(leaf, b));
  return -cosine >= kCosSharp || cosine >= kCosDoubled;
}

/// Maps a number to bits that sort as the numbers do.
std::uint32_t ordered_bits(float number) {
  constexpr std::uint32_t kSign = 0x80000000;
  const auto bits = std::bit_cast<std::uint32_t>(number + 0.0f);  // -0 becomes 0
  return bits & kSign ? ~bits : bits | kSign;
}

std::size_t count_of(std::span<const std::uint32_t> welded) {
  return welded.empty() ? 0 : std::ranges::max(welded) + std::size_t{1};
}

std::vector<Vec3f> distinct_positions(const Primitive& primitive,
                                      std::span<const std::uint32_t> welded) {
  std::vector<Vec3f> distinct(count_of(welded));
  for (std::size_t i = 0; i < welded.size(); ++i) {
    distinct[welded[i]] = primitive.positions[i] + Vec3f(0, 0, 0);  // -0 becomes 0
  }
  return distinct;
}

}  // namespace

std::vector<std::uint32_t> weld_positions(const Primitive& primitive) {
  struct Stored {
    std::uint64_t xy;
    std::uint32_t z, vertex;
    auto operator<=>(const Stored&) const = default;
    bool lies_at(const Stored& other) const { return xy == other.xy && z == other.z; }
  };
  std::vector<Stored> stored(primitive.positions.size());
  tbb::parallel_for(std::size_t{0}, stored.size(), [&](std::size_t i) {
    const Vec3f p = primitive.positions[i];
    stored[i] = {std::uint64_t{ordered_bits(p.x)} << 32 | ordered_bits(p.y), ordered_bits(p.z),
                 static_cast<std::uint32_t>(i)};
  });
  tbb::parallel_sort(stored.begin(), stored.end());

  std::vector<std::uint32_t> welded(stored.size());
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < stored.size(); ++i) {
    if (i > 0 && !stored[i].lies_at(stored[i - 1])) ++number;
    welded[stored[i].vertex] = number;
  }
  return welded;
}

bool is_welded(const Primitive& primitive, std::span<const std::uint32_t> welded) {
  if (welded.size() != primitive.positions.size() || count_of(welded) > welded.size()) return false;
  const std::vector<Vec3f> distinct = distinct_positions(primitive, welded);
  const auto differs = [&](std::size_t i) { return distinct[welded[i]] != primitive.positions[i]; };
  for (std::size_t i = 0; i < welded.size(); ++i) {
    if (differs(i)) return false;
  }
  const auto is_not_before = [](Vec3f a, Vec3f b) {
    return std::tie(a.x, a.y, a.z) >= std::tie(b.x, b.y, b.z);
  };
  return std::ranges::adjacent_find(distinct, is_not_before) == distinct.end();
}

WeldedMesh weld(const Primitive& primitive, std::span<const std::uint32_t> welded,
                const std::vector<bool>& triangles) {
  WeldedMesh mesh;
  mesh.positions = distinct_positions(primitive, welded);
  mesh.faces.reserve(primitive.triangles.size());
  for (std::size_t t = 0; t < primitive.triangles.size(); ++t) {
    if (!triangles.empty() && !triangles[t]) continue;
    const auto [a, b, c] = primitive.triangles[t];
    mesh.faces.push_back(least_rotation({{welded[a], welded[b], welded[c]}, {a, b, c}}));
  }
  tbb::parallel_sort(mesh.faces.begin(), mesh.faces.end());
  return mesh;
}

std::vector<std::uint32_t> label_pieces(const Primitive& primitive,
                                        std::span<const std::uint32_t> welded) {
  UnionFind sets(count_of(welded));
  for (const auto& [a, b, c] : primitive.triangles) {
    sets.unite(welded[a], welded[b]);
    sets.unite(welded[a], welded[c]);
  }
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> number(count_of(welded), kNone), labels;
  labels.reserve(primitive.triangles.size());
  std::uint32_t count = 0;
  for (const auto& triangle : primitive.triangles) {
    std::uint32_t& label = number[sets.find(welded[triangle[0]])];
    if (label == kNone) label = count++;
    labels.push_back(label);
  }
  return labels;
}

FaceGroups connected_components(const WeldedMesh& mesh) {
  UnionFind sets(mesh.positions.size());
  for (const Face& face : mesh.faces) {
    sets.unite(face.position[0], face.position[1]);
    sets.unite(face.position[0], face.position[2]);
  }
  std::vector<std::uint32_t> labels;
  labels.reserve(mesh.faces.size());
  for (const Face& face : mesh.faces) labels.push_back(sets.find(face.position[0]));
  return {mesh.faces, labels};
}

FaceGroups split_at_sharp_edges(const LeafMesh& leaf) {
  const auto face_count = static_cast<std::uint32_t>(leaf.faces.size());
  const std::vector<EdgeSide> sides = edge_sides(leaf);
  UnionFind sets(face_count);
  for (auto begin = sides.begin(); begin != sides.end();) {
    const auto end = std::find_if(begin, sides.end(),
                                  [&](const EdgeSide& side) { return side.ends != begin->ends; });
    for (auto a = begin; a != end; ++a) {
      for (auto b = a + 1; b != end; ++b) {
        if (is_smooth(leaf, *a, *b)) sets.unite(a->face, b->face);
      }
    }
    begin = end;
  }
  std::vector<std::uint32_t> labels(face_count);
  for (std::uint32_t face = 0; face < face_count; ++face) labels[face] = sets.find(face);
  return {leaf.faces, labels};
}

FaceGroups split_into_triangles(std::span<const Face> faces) {
  struct Corners {
    std::array<std::uint32_t, 3> sorted;
    std::uint32_t face;
    auto operator<=>(const Corners&) const = default;
  };
  std::vector<Corners> corners;
  corners.reserve(faces.size());
  for (const Face& face : faces) {
    auto sorted = face.position;
    std::ranges::sort(sorted);
    corners.push_back({sorted, static_cast<std::uint32_t>(corners.size())});
  }
  std::ranges::sort(corners);
  std::vector<std::uint32_t> labels(faces.size());
  std::uint32_t label = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i == 0 || corners[i].sorted != corners[i - 1].sorted) label = corners[i].face;
    labels[corners[i].face] = label;
  }
  return {faces, labels};
}

}  // namespace leafhull
