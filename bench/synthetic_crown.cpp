// SPDX-License-Identifier: Apache-2.0
#include "bench/synthetic_crown.h"

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "leafhull/error.h"

namespace leafhull::bench {
namespace {

constexpr std::size_t kLeavesPerTwig = 40;
constexpr double kTwigLength = 0.8;
constexpr double kTwigWidth = 0.15;  // how far a leaf lies from its twig, at most
constexpr double kLeafLength = 0.12;
constexpr double kLeafWidth = 0.08;
constexpr double kLeavesPerVolume = 85;       // a crown of 100 k vertices is 10 high
constexpr Vec3d kProportions{0.75, 1, 0.75};  // half-axes of the crown over half its height

/// Numbers that do not depend on the standard library.
class Random {
 public:
  /// A number in [0, 1).
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  Vec3d direction() {
    const double z = 2 * unit() - 1, angle = 2 * std::numbers::pi * unit();
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

  /// A point in the unit ball.
  Vec3d in_ball() { return direction() * std::cbrt(unit()); }

 private:
  std::mt19937_64 engine_{1};
};

void add_leaf(Primitive& leaves, Vec3d centre, Random& random) {
  const Vec3d along = random.direction();
  const Vec3d normal = normalized(cross(along, random.direction()));
  const Vec3d u = along * (kLeafLength / 2), v = cross(normal, along) * (kLeafWidth / 2);
  const auto first = static_cast<std::uint32_t>(leaves.positions.size());
  for (const Vec3d corner : {centre - u - v, centre + u - v, centre + u + v, centre - u + v}) {
    leaves.positions.emplace_back(corner);
    leaves.normals.emplace_back(normal);
  }
  leaves.triangles.push_back({first, first + 1, first + 2});
  leaves.triangles.push_back({first, first + 2, first + 3});
}

}  // namespace

TreeModel synthetic_crown(std::size_t leaf_vertices) {
  if (leaf_vertices == 0 || leaf_vertices % 4 != 0) {
    throw Error(ErrorCode::usage,
                "a synthetic crown of " + std::to_string(leaf_vertices) +
                    " leaf vertices has no whole number of quads",
                "Give a multiple of four.");
  }
  const std::size_t leaf_count = leaf_vertices / 4;
  const double volume = static_cast<double>(leaf_count) / kLeavesPerVolume;
  const double half_height =
      std::cbrt(volume / (4.0 / 3 * std::numbers::pi * kProportions.x * kProportions.z));

  Primitive leaves;
  leaves.material = 0;
  Random random;
  Vec3d twig, twig_direction;
  for (std::size_t i = 0; i < leaf_count; ++i) {
    if (i % kLeavesPerTwig == 0) {
      const Vec3d p = random.in_ball() * half_height;
      twig = {p.x * kProportions.x, p.y * kProportions.y, p.z * kProportions.z};
      twig_direction = random.direction();
    }
    const Vec3d on_twig = twig + twig_direction * (kTwigLength * (random.unit() - 0.5));
    add_leaf(leaves, on_twig + random.in_ball() * kTwigWidth, random);
  }
  TreeModel tree;
  tree.path = "synthetic:" + std::to_string(leaf_vertices);
  tree.materials.emplace_back().name = "leaves";
  tree.primitives.push_back(std::move(leaves));
  tree.instances.emplace_back();
  return tree;
}

}  // namespace leafhull::bench
