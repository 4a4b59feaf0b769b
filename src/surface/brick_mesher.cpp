// SPDX-License-Identifier: Apache-2.0
#include "surface/brick_mesher.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "density/field_grid.h"
#include "surface/cell_shapes.h"

namespace leafhull {
namespace {

using GridAccessor = openvdb::FloatGrid::ConstAccessor;
using GridCoord = openvdb::Coord;
using Index = std::uint32_t;
using Quad = std::array<Index, 4>;

constexpr unsigned kEdge = kBrickEdge;

/// A bit per sample or cell of a brick: a word per x, bit 8 y + z.
using Bits = std::array<std::uint64_t, kEdge>;

/// Values of a brick's samples or cells, and of the adjacent layer of its upper neighbours.
template <class Value>
class Cube {
 public:
  static constexpr unsigned index(unsigned x, unsigned y, unsigned z) {
    return (x * kSide + y) * kSide + z;
  }
  Value& operator()(unsigned x, unsigned y, unsigned z) { return values_[index(x, y, z)]; }
  const Value& operator()(unsigned x, unsigned y, unsigned z) const {
    return values_[index(x, y, z)];
  }

 private:
  static constexpr unsigned kSide = kEdge + 1;
  std::array<Value, kSide * kSide * kSide> values_;
};

struct Cell {
  std::uint16_t first_vertex;  ///< among its brick's vertices
  std::uint16_t shape;
};

/// The cells with their lowest corner in a brick.
struct BrickCells {
  std::array<Index, 8> neighbours;          ///< bricks; by bits: +x 4, +y 2, +z 1
  Bits crossed;                             ///< by the surface
  std::array<std::uint16_t, kEdge> before;  ///< crossed cells at lower x
  std::vector<Cell> cells;                  ///< the crossed ones, in the order of their bits
  Index first_vertex = 0, first_face = 0;

  Cell cell(unsigned x, unsigned bit) const {
    const std::uint64_t lower = crossed[x] & ((std::uint64_t{1} << bit) - 1);
    return cells[before[x] + static_cast<unsigned>(std::popcount(lower))];
  }
};

template <class Visit>
void for_each_bit(std::uint64_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<unsigned>(std::countr_zero(bits)));
}

template <class Visit>
void for_each_cell(const BrickCells& brick, const Visit& visit) {
  const Cell* cell = brick.cells.data();
  for (unsigned x = 0; x < kEdge; ++x) {
    for_each_bit(brick.crossed[x], [&](unsigned b) { visit(*cell++, x, b / kEdge, b % kEdge); });
  }
}

/// A corner of the cube [low, low + edge]; bit 2 of its number is x, bit 1 y, bit 0 z.
GridCoord corner_of(const GridCoord& low, int edge, unsigned corner) {
  return low.offsetBy(corner & 4 ? edge : 0, corner & 2 ? edge : 0, corner & 1 ? edge : 0);
}

std::uint64_t next_y(std::uint64_t here, std::uint64_t above) { return here >> 8 | above << 56; }
std::uint64_t next_z(std::uint64_t here, std::uint64_t above) {
  return (here >> 1 & 0x7f7f7f7f7f7f7f7f) | (above << 7 & 0x8080808080808080);
}

/// Where an edge of a cell is crossed.
struct Crossing {
  unsigned low, high;  ///< indices of its ends in a Cube, from the cell's lowest corner
  Vec3f start, direction;
};

constexpr auto kCrossings = [] {
  std::array<Crossing, 12> crossings{};
  for (unsigned e = 0; e < 12; ++e) {
    const auto [axis, low] = cell::edge(e);
    const auto index = [](unsigned corner) {
      return Cube<float>::index(corner >> 2 & 1, corner >> 1 & 1, corner & 1);
    };
    const auto vector = [](unsigned corner) {
      return Vec3f(corner & 4 ? 1 : 0, corner & 2 ? 1 : 0, corner & 1 ? 1 : 0);
    };
    const unsigned along = cell::bit(axis);
    crossings[e] = {index(low), index(low | along), vector(low), vector(along)};
  }
  return crossings;
}();

/// Rounds a fraction of a cell to a multiple of 2^-14. In a part, adding it to a cell's number is
/// then exact, and a point does not depend on the anchor.
float rounded(float fraction) {
  constexpr float kFractions = 1 << 14;
  return std::min(std::round(fraction * kFractions), kFractions - 1) / kFractions;
}

/// low + fraction, kept below low + 1.
float within_cell(float low, float fraction) {
  const float p = low + fraction;
  return p < low + 1 ? p : std::nextafter(low + 1, low);
}

/// What a brick adds to the requested part: `own` its faces, `upper` perhaps some points, `beside`
/// nothing, as it only determines the cells next to it.
enum class Role { own, upper, beside };

Role role_of(const GridCoord& brick, const SampleBox& own) {
  const auto within = [](int at, int low, int high) { return at >= low && at <= high; };
  if (!within(brick.x(), own.low.x, own.high.x) || !within(brick.y(), own.low.y, own.high.y) ||
      !within(brick.z(), own.low.z, own.high.z))
    return Role::beside;
  const bool upper = brick.x() == own.high.x || brick.y() == own.high.y || brick.z() == own.high.z;
  return upper ? Role::upper : Role::own;
}

class BrickMesher {
 public:
  /// Meshes everything if `own` is null.
  BrickMesher(const Field& field, const SampleBox* own);
  OwnedPolygons mesh();

 private:
  void find_neighbours(Index first, Index end);
  void find_cells(Index b);
  unsigned shape_of(unsigned inside, const GridCoord& at, const GridAccessor& negated) const;
  Cube<float> samples_of(const BrickCells& brick) const;
  void place_vertices(Index b, Vec3f* points) const;
  void add_faces(const BrickCells& brick, Quad* faces) const;

  const openvdb::FloatGrid& negated_;
  const float iso_;
  std::vector<const Brick*> bricks_;  ///< in ascending order of their origins
  // The last two entries stand for blocks that are proven outside and inside.
  std::vector<const float*> values_;
  std::vector<Bits> inside_;
  std::array<float, kBrickSamples> proven_outside_, proven_inside_;
  std::vector<BrickCells> cells_;
  const bool part_;  ///< false: the whole surface
  std::vector<Role> roles_;
};

BrickMesher::BrickMesher(const Field& field, const SampleBox* own)
    : negated_(negated_grid(field)),
      iso_(field.iso_value()),
      bricks_(bricks_of(field).begin(), bricks_of(field).end()),
      values_(bricks_.size() + 2),
      inside_(bricks_.size() + 2),
      cells_(bricks_.size()),
      part_(own != nullptr),
      roles_(bricks_.size(), Role::own) {
  tbb::parallel_sort(bricks_,
                     [](const Brick* a, const Brick* b) { return a->origin() < b->origin(); });
  std::transform(bricks_.begin(), bricks_.end(), values_.begin(),
                 [](const Brick* b) { return b->buffer().data(); });
  if (own) {
    std::transform(bricks_.begin(), bricks_.end(), roles_.begin(),
                   [&](const Brick* b) { return role_of(b->origin(), *own); });
  }
  proven_outside_.fill(negated_.background());
  proven_inside_.fill(-inside_value(field.threshold()));
  values_[bricks_.size()] = proven_outside_.data();
  values_[bricks_.size() + 1] = proven_inside_.data();
  tbb::parallel_for(std::size_t{0}, inside_.size(), [&](std::size_t b) {
    const float* value = values_[b];
    for (std::uint64_t& layer : inside_[b]) {
      for (unsigned bit = 0; bit < 64; ++bit) layer |= std::uint64_t{*value++ < iso_} << bit;
    }
  });
}

/// Passes over the bricks once per direction, since both bricks and neighbours are in order.
void BrickMesher::find_neighbours(Index first, Index end) {
  const auto bricks = static_cast<Index>(bricks_.size());
  const GridAccessor negated = negated_.getConstAccessor();
  for (unsigned i = 0; i < 8; ++i) {
    Index n = first;
    for (Index b = first; b < end; ++b) {
      const GridCoord origin = corner_of(bricks_[b]->origin(), kBrickEdge, i);
      while (n < bricks && bricks_[n]->origin() < origin) ++n;
      const bool evaluated = n < bricks && bricks_[n]->origin() == origin;
      cells_[b].neighbours[i] = evaluated                         ? n
                                : negated.getValue(origin) < iso_ ? bricks + 1
                                                                  : bricks;
    }
  }
}

void BrickMesher::find_cells(Index b) {
  BrickCells& brick = cells_[b];
  std::array<std::array<std::uint64_t, 4>, kEdge + 1> inside;  // at +0 or +1 along y, z: bits 1, 0
  for (unsigned x = 0; x <= kEdge; ++x) {
    const auto layer = [&](unsigned i) {
      return inside_[brick.neighbours[x / kEdge << 2 | i]][x % kEdge];
    };
    const std::uint64_t low = layer(0), y = layer(2), z = next_z(low, layer(1));
    inside[x] = {low, z, next_y(low, y), next_y(z, next_z(y, layer(3)))};
  }

  unsigned count = 0;
  for (unsigned x = 0; x < kEdge; ++x) {
    const auto& [a0, a1, a2, a3] = inside[x];
    const auto& [b0, b1, b2, b3] = inside[x + 1];
    brick.crossed[x] =
        (a0 | a1 | a2 | a3 | b0 | b1 | b2 | b3) & ~(a0 & a1 & a2 & a3 & b0 & b1 & b2 & b3);
    brick.before[x] = static_cast<std::uint16_t>(count);
    count += static_cast<unsigned>(std::popcount(brick.crossed[x]));
  }

  const GridAccessor negated = negated_.getConstAccessor();
  brick.cells.reserve(count);
  for (unsigned x = 0; x < kEdge; ++x) {
    for_each_bit(brick.crossed[x], [&](unsigned bit) {
      unsigned corners = 0;
      for (unsigned i = 0; i < 8; ++i) {
        corners |= static_cast<unsigned>(inside[x + i / 4][i % 4] >> bit & 1) << i;
      }
      const GridCoord at = bricks_[b]->origin().offsetBy(
          static_cast<int>(x), static_cast<int>(bit / kEdge), static_cast<int>(bit % kEdge));
      const unsigned shape = shape_of(corners, at, negated);
      brick.cells.push_back(
          {static_cast<std::uint16_t>(brick.first_vertex), static_cast<std::uint16_t>(shape)});
      brick.first_vertex += cell::kShapes[shape].vertices;
      for (unsigned axis = 0; axis < 3; ++axis) {
        brick.first_face += (corners >> 7 ^ corners >> (7 ^ cell::bit(axis))) & 1;
      }
    });
  }
}

/// The number of the shape of the cell at `at`.
unsigned BrickMesher::shape_of(unsigned inside, const GridCoord& at,
                               const GridAccessor& negated) const {
  const unsigned face = cell::kFaceMetTwice[inside];
  if (face == cell::kNoFace) return inside;
  GridCoord beyond = at;
  beyond[static_cast<int>(face / 2)] += face % 2 ? 1 : -1;
  unsigned inside_beyond = 0;
  for (unsigned i = 0; i < 8; ++i) {
    inside_beyond |= unsigned{negated.getValue(corner_of(beyond, 1, i)) < iso_} << i;
  }
  return cell::kFaceMetTwice[inside_beyond] == (face ^ 1) ? inside + cell::kParted : inside;
}

Cube<float> BrickMesher::samples_of(const BrickCells& brick) const {
  Cube<float> samples;
  for (unsigned x = 0; x <= kEdge; ++x) {
    for (unsigned y = 0; y <= kEdge; ++y) {
      const unsigned i = x / kEdge << 2 | y / kEdge << 1;
      const unsigned row = (x % kEdge * kEdge + y % kEdge) * kEdge;
      std::copy_n(values_[brick.neighbours[i]] + row, kEdge, &samples(x, y, 0));
      samples(x, y, kEdge) = values_[brick.neighbours[i | 1]][row];
    }
  }
  return samples;
}

void BrickMesher::place_vertices(Index b, Vec3f* points) const {
  const GridCoord origin = bricks_[b]->origin();
  const Cube<float> samples = samples_of(cells_[b]);
  for_each_cell(cells_[b], [&](Cell at, unsigned x, unsigned y, unsigned z) {
    const cell::Shape& shape = cell::kShapes[at.shape];
    const float* const corner = &samples(x, y, z);
    for (unsigned v = 0; v < shape.vertices; ++v) {
      Vec3f sum{};
      float count = 0;
      for_each_bit(shape.crossed[v], [&](unsigned e) {
        const auto& [low, high, start, direction] = kCrossings[e];
        const float t = (iso_ - corner[low]) / (corner[high] - corner[low]);
        sum = sum + start + direction * t;
        ++count;
      });
      const auto place = [&](int from, unsigned step, float total) {
        const float fraction = part_ ? rounded(total / count) : total / count;
        return within_cell(static_cast<float>(from + static_cast<int>(step)), fraction);
      };
      *points++ = {place(origin.x(), x, sum.x), place(origin.y(), y, sum.y),
                   place(origin.z(), z, sum.z)};
    }
  });
}

/// The quads around the lattice edges that end at the highest corners of the brick's cells.
void BrickMesher::add_faces(const BrickCells& brick, Quad* faces) const {
  struct Vertices {
    Index first;
    std::uint16_t shape;
  };
  Cube<Vertices> vertices;  // of the crossed cells
  for (unsigned i = 0; i < 8; ++i) {
    if (brick.neighbours[i] >= cells_.size()) continue;
    const BrickCells& from = cells_[brick.neighbours[i]];
    const std::uint64_t part =
        (i & 2 ? 0xff : ~std::uint64_t{0}) & (i & 1 ? 0x0101010101010101 : ~std::uint64_t{0});
    for (unsigned x = 0; x < (i & 4 ? 1 : kEdge); ++x) {
      for_each_bit(from.crossed[x] & part, [&](unsigned bit) {
        const Cell cell = from.cell(x, bit);
        vertices(x + (i & 4 ? kEdge : 0), bit / kEdge + (i & 2 ? kEdge : 0),
                 bit % kEdge + (i & 1 ? kEdge : 0)) = {from.first_vertex + cell.first_vertex,
                                                       cell.shape};
      });
    }
  }

  for_each_cell(brick, [&](Cell at, unsigned x, unsigned y, unsigned z) {
    const unsigned inside = at.shape;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const unsigned next = cell::bit(axis + 1), last = cell::bit(axis + 2);
      const bool high_inside = inside >> 7 & 1;
      if (high_inside == (inside >> (next | last) & 1)) continue;
      const auto vertex = [&](unsigned step, unsigned edge) {
        const auto [first, shape] =
            vertices(x + (step >> 2 & 1), y + (step >> 1 & 1), z + (step & 1));
        return first + cell::kShapes[shape].vertex[4 * axis + edge];
      };
      // Counter-clockwise seen from the high end of the edge.
      Quad face{vertex(0, 3), vertex(next, 2), vertex(next | last, 0), vertex(last, 1)};
      if (high_inside) std::swap(face[1], face[3]);
      *faces++ = face;
    }
  });
}

OwnedPolygons BrickMesher::mesh() {
  const auto bricks = static_cast<Index>(bricks_.size());
  tbb::parallel_for(tbb::blocked_range<Index>(0, bricks), [&](const auto& range) {
    find_neighbours(range.begin(), range.end());
    for (Index b = range.begin(); b < range.end(); ++b) find_cells(b);
  });
  OwnedPolygons part;
  Index vertices = 0, faces = 0;
  for (const Role role : {Role::own, Role::upper}) {
    for (Index b = 0; b < bricks; ++b) {
      if (roles_[b] != role) continue;
      vertices += std::exchange(cells_[b].first_vertex, vertices);
      if (role == Role::own) faces += std::exchange(cells_[b].first_face, faces);
    }
    if (role == Role::own) part.own = vertices;
  }
  Polygons& polygons = part.polygons;
  polygons.points.resize(vertices);
  polygons.faces.resize(faces);
  tbb::parallel_for(Index{0}, bricks, [&](Index b) {
    if (roles_[b] == Role::beside) return;
    place_vertices(b, polygons.points.data() + cells_[b].first_vertex);
    if (roles_[b] != Role::own) return;
    add_faces(cells_[b], polygons.faces.data() + cells_[b].first_face);
  });
  return part;
}

/// Numbers the points within each cell. Points of one cell are consecutive.
std::vector<std::uint8_t> patches_of(std::span<const Vec3f> points) {
  std::vector<std::uint8_t> patches(points.size(), 0);
  for (std::size_t v = 1; v < points.size(); ++v) {
    if (cell_of(Vec3d(points[v])) != cell_of(Vec3d(points[v - 1]))) continue;
    patches[v] = static_cast<std::uint8_t>(patches[v - 1] + 1);
  }
  return patches;
}

/// Removes points of other parts that no face uses.
void drop_unused(OwnedPolygons& part) {
  Polygons& polygons = part.polygons;
  const auto points = static_cast<Index>(polygons.points.size());
  std::vector<Index> moved_to(points - part.own, 0);
  for (const Quad& face : polygons.faces) {
    for (const Index v : face) {
      if (v >= part.own) moved_to[v - part.own] = 1;
    }
  }
  Index next = part.own;
  for (Index v = part.own; v < points; ++v) {
    if (moved_to[v - part.own] == 0) continue;
    polygons.points[next] = polygons.points[v];
    part.patches[next] = part.patches[v];
    moved_to[v - part.own] = next++;
  }
  polygons.points.resize(next);
  part.patches.resize(next);
  tbb::parallel_for(std::size_t{0}, polygons.faces.size(), [&](std::size_t f) {
    for (Index& v : polygons.faces[f]) {
      if (v >= part.own) v = moved_to[v - part.own];
    }
  });
}

}  // namespace

Polygons mesh_bricks(const Field& field) { return BrickMesher(field, nullptr).mesh().polygons; }

OwnedPolygons mesh_bricks(const Field& field, const SampleBox& own) {
  OwnedPolygons part = BrickMesher(field, &own).mesh();
  part.patches = patches_of(part.polygons.points);
  drop_unused(part);
  return part;
}

}  // namespace leafhull
