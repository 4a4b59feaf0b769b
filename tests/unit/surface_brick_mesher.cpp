// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <unordered_map>

#include "density/field_grid.h"
#include "surface/brick_mesher.h"
#include "surface/cell_shapes.h"
#include "surface/mesh_components.h"
#include "unit/surface_test_fields.h"

namespace leafhull {
namespace {

/// Whether the faces around every vertex form one closed fan: each corner of a face leads from one
/// neighbour of the vertex to the next, and the path from any neighbour passes all of them.
bool is_manifold(const Polygons& polygons) {
  std::vector<std::unordered_map<std::uint32_t, std::uint32_t>> fans(polygons.points.size());
  for (const auto& face : polygons.faces) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [from, at, to] = std::array{face[i], face[(i + 1) % 4], face[(i + 2) % 4]};
      if (!fans[at].emplace(to, from).second)
        return false;  // an edge occurs twice in one direction
    }
  }
  return std::all_of(fans.begin(), fans.end(), [](const auto& fan) {
    if (fan.empty()) return false;
    std::size_t passed = 0;
    auto corner = fan.begin();
    do {
      corner = fan.find(corner->second);
      if (corner == fan.end()) return false;  // an edge has a face only on one side
    } while (++passed < fan.size() && corner != fan.begin());
    return passed == fan.size();
  });
}

/// V - E + F; each quad accounts for two edges.
std::ptrdiff_t euler_characteristic(const Polygons& polygons) {
  return static_cast<std::ptrdiff_t>(polygons.points.size()) -
         static_cast<std::ptrdiff_t>(polygons.faces.size());
}

/// A bit for each corner of a cell that is inside.
unsigned inside_of(const Field& field, Coord at) {
  unsigned inside = 0;
  for (int i = 0; i < 8; ++i) {
    const openvdb::Coord corner(at.x + (i >> 2 & 1), at.y + (i >> 1 & 1), at.z + (i & 1));
    inside |= unsigned{negated_grid(field).tree().getValue(corner) < field.iso_value()} << i;
  }
  return inside;
}

void expect_good(const Polygons& polygons, const Field& field) {
  EXPECT_TRUE(is_manifold(polygons));
  EXPECT_GT(volume(polygons), 0) << "faces look inward";
  for (const Vec3f p : polygons.points) {
    const unsigned inside = inside_of(field, cell_of(Vec3d(p)));
    ASSERT_TRUE(inside != 0 && inside != 255) << "a vertex in a cell without a surface";
  }
}

/// Random samples, about `share` of them inside; the outermost ones are outside.
Field noise(unsigned seed, double share) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  return field_of(
      [&](Vec3d p) {
        const double n = unit(random);
        const bool outermost = std::min({p.x, p.y, p.z}) == -16 || std::max({p.x, p.y, p.z}) == 15;
        return outermost ? 0 : n;
      },
      1 - share, kLow, kHigh);
}

/// Samples from -5 to 5 are inside, except for those in `out`; inverted, only those in `out` are.
Field block(std::vector<Vec3d> out, bool inverted = false) {
  return field_of(
      [=](Vec3d p) {
        const bool in_block = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) <= 5;
        const bool found = std::find(out.begin(), out.end(), p) != out.end();
        return (inverted ? found : in_block && !found) ? 2.0 : 0.0;
      },
      1.0, kLow, kHigh);
}

TEST(BrickMesher, OneSampleInsideIsABoxOfTheMeansOfItsCrossings) {
  const Field field = block({{0, 0, 0}}, true);  // edges are cut halfway: vertices at (1, 1, 1) / 6
  const Polygons polygons = mesh_bricks(field);
  EXPECT_EQ(polygons.points.size(), 8u);
  EXPECT_EQ(polygons.faces.size(), 6u);
  expect_good(polygons, field);
  for (const Vec3f p : polygons.points) {
    EXPECT_NEAR(std::fabs(p.x), 1 / 6.0, 1e-6);
    EXPECT_NEAR(std::fabs(p.y), 1 / 6.0, 1e-6);
    EXPECT_NEAR(std::fabs(p.z), 1 / 6.0, 1e-6);
  }
}

TEST(BrickMesher, ASphereIsRound) {
  const double radius = 12.3;
  const auto ball = [&](Vec3d p) { return 2 - dot(p, p) / (radius * radius); };
  const Field field = field_of(ball, 1.0, kLow, kHigh);
  const Polygons polygons = mesh_bricks(field);
  expect_good(polygons, field);
  EXPECT_EQ(euler_characteristic(polygons), 2);
  EXPECT_NEAR(volume(polygons) / (4.0 / 3 * std::numbers::pi * std::pow(radius, 3)), 1, 0.01);
}

TEST(BrickMesher, ATorusHasAHole) {
  const double major = 8.7, minor = 5.9;
  const auto torus = [&](Vec3d p) {
    const double ring = std::hypot(p.x, p.y) - major;
    return 2 - (ring * ring + p.z * p.z) / (minor * minor);
  };
  const Field field = field_of(torus, 1.0, kLow, kHigh);
  const Polygons polygons = mesh_bricks(field);
  expect_good(polygons, field);
  EXPECT_EQ(euler_characteristic(polygons), 0);
  const double exact = 2 * std::numbers::pi * std::numbers::pi * major * minor * minor;
  EXPECT_NEAR(volume(polygons) / exact, 1, 0.02);
}

TEST(BrickMesher, TwoBlobsThatTouchAndTwoThatDoNot) {
  const auto blobs = [](double gap) {
    return field_of(
        [=](Vec3d p) {
          const Vec3d d(6 + gap, 0.3, 0.2), a = p - d, b = p + d;
          return 2 - std::min(dot(a, a), dot(b, b)) / 36;
        },
        1.0, kLow, kHigh);
  };
  for (const auto& [gap, characteristic] : {std::pair{-0.6, 2}, {0.6, 4}}) {
    const Field field = blobs(gap);
    const Polygons polygons = mesh_bricks(field);
    expect_good(polygons, field);
    EXPECT_EQ(euler_characteristic(polygons), characteristic);
  }
}

TEST(BrickMesher, SamplesAtTheThresholdAreInside) {
  const Field field = field_of(
      [](Vec3d p) {
        return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) <= 3 ? 1.0 : 0.0;
      },
      1.0, kLow, kHigh);
  const Polygons polygons = mesh_bricks(field);
  expect_good(polygons, field);  // vertices lie at samples, yet each in its own cell
  EXPECT_EQ(polygons.faces.size(), 6u * 7 * 7);
  EXPECT_NEAR(volume(polygons), 6 * 6 * 6, 1e-3);
}

TEST(BrickMesher, PairsAcrossTheDiagonalOfAFaceAreTwo) {
  // If the pair is inside, the patches of both cells beside the face go around it, which would put
  // two mesh edges between the same two vertices; the surface must part the pair instead. A pair
  // outside is always parted. The pairs lie in a brick and across its faces and edges.
  for (const Vec3d a : {Vec3d(2, 2, 2), Vec3d(0, 2, 2), Vec3d(-1, -1, 2), Vec3d(-1, 2, 0)}) {
    for (const Vec3d step : {Vec3d(0, 1, 1), Vec3d(1, 0, 1), Vec3d(1, 1, 0), Vec3d(-1, 1, 0)}) {
      const Field pair = block({a, a + step}, true), hollows = block({a, a + step});
      expect_good(mesh_bricks(pair), pair);
      EXPECT_EQ(euler_characteristic(mesh_bricks(pair)), 4);
      expect_good(mesh_bricks(hollows), hollows);
      EXPECT_EQ(euler_characteristic(mesh_bricks(hollows)), 6) << "the block and two hollows";
    }
  }
}

TEST(BrickMesher, NoiseIsManifold) {
  std::set<unsigned> cases;
  int parted = 0;  // the number of pairs of cells whose surface is parted
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Field field = noise(seed, 0.2 + 0.1 * seed);
    expect_good(mesh_bricks(field), field);
    for (int x = -16; x < 15; ++x) {
      for (int y = -16; y < 15; ++y) {
        for (int z = -16; z < 15; ++z) {
          const unsigned inside = inside_of(field, {x, y, z});
          cases.insert(inside);
          if (cell::kFaceMetTwice[inside] != 5) continue;  // the upper one along z
          parted += cell::kFaceMetTwice[inside_of(field, {x, y, z + 1})] == 4;
        }
      }
    }
  }
  EXPECT_EQ(cases.size(), 256u);
  EXPECT_GT(parted, 100);
}

TEST(BrickMesher, JoinsAndPartsWhatOpenVdbDoes) {
  const auto counts = [](Polygons polygons) {
    const std::size_t points = polygons.points.size(), faces = polygons.faces.size();
    return std::array{points, faces, std::size_t{drop_small_components(polygons, 0).kept}};
  };
  for (unsigned seed = 0; seed < 12; ++seed) {
    const Field field = noise(seed, 0.1 + 0.07 * seed);
    EXPECT_EQ(counts(mesh_bricks(field)), counts(polygonise(field, 0)));
  }
}

TEST(BrickMesher, ProvenBlocksStandForEvaluatedOnes) {
  const auto ball = [](Vec3d p) { return 2 - dot(p, p) / (16.2 * 16.2); };
  const Field dense = field_of(ball, 1.0, {-24, -24, -24}, {24, 24, 24});
  Field sparse({}, 1.0);
  std::vector<InsideBlock> inside;
  for (const Brick* brick : bricks_of(dense)) {
    const Coord o{brick->origin().x(), brick->origin().y(), brick->origin().z()};
    const Vec3d middle = to_vec3d(o) + Vec3d(4, 4, 4);
    if (length(middle) < 8) {  // holds for the eight bricks around the origin
      inside.push_back({{o, kBrickEdge}, 1.0});
    } else {
      add_brick(sparse, ball, o);
    }
  }
  ASSERT_EQ(inside.size(), 8u);
  sparse.add_inside(inside);
  const Polygons a = mesh_bricks(dense), b = mesh_bricks(sparse);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.faces, b.faces);
}

TEST(BrickMesher, NeitherThreadsNorTheOrderOfBricksMatter) {
  const Field field = noise(3, 0.5);
  const Polygons expected = mesh_bricks(field);

  std::vector<const Brick*> bricks(bricks_of(field).begin(), bricks_of(field).end());
  std::shuffle(bricks.begin(), bricks.end(), std::mt19937(1));
  Field shuffled({}, field.threshold());
  for (const Brick* brick : bricks) {
    const auto negated = [&](Vec3d p) {
      return -brick->getValue(openvdb::Coord::floor(openvdb::Vec3d(p.x, p.y, p.z)));
    };
    add_brick(shuffled, negated, {brick->origin().x(), brick->origin().y(), brick->origin().z()});
  }
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const Polygons other = mesh_bricks(shuffled);
  EXPECT_EQ(other.points, expected.points);
  EXPECT_EQ(other.faces, expected.faces);
}

TEST(BrickMesher, NothingInsideIsNoSurface) {
  const Field field = field_of([](Vec3d) { return 0.5; }, 1.0, kLow, kHigh);
  EXPECT_TRUE(mesh_bricks(field).points.empty());
  EXPECT_TRUE(mesh_bricks(Field({}, 1.0)).faces.empty());
}

}  // namespace
}  // namespace leafhull
