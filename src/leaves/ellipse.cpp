// SPDX-License-Identifier: Apache-2.0
#include "leaves/ellipse.h"

#include <algorithm>
#include <tuple>

namespace leafhull {
namespace {

// Texture coordinates whose spread has a smaller determinant, relative to its squared trace, lie on
// a line.
constexpr double kLeastSpread = 1e-12;
// The sine of the angle below which two half axes lie on one line.
constexpr double kLeastSine = 1e-6;

/// A point of a leaf and its place in the texture.
struct UvPoint {
  std::uint32_t point;  ///< into LeafMesh::points
  Eigen::Vector2d uv;

  auto key() const { return std::tuple(point, uv.x(), uv.y()); }
};

/// Each pair once, however many faces hold it. The back faces of a leaf may show another part of
/// the texture, or a mirrored one, and would spoil the map of the front.
std::vector<UvPoint> uv_points(const LeafMesh& leaf, std::span<const Vec2f> uvs,
                               const Eigen::Vector3d& normal) {
  std::vector<UvPoint> pairs;
  pairs.reserve(3 * leaf.faces.size());
  for (std::size_t face = 0; face < leaf.faces.size(); ++face) {
    if (!(leaf.areas[face].dot(normal) > 0)) continue;
    for (int corner = 0; corner < 3; ++corner) {
      const Vec2f& uv = uvs[leaf.faces[face].vertex[corner]];
      pairs.push_back({leaf.triangles[face][corner], {uv.x, uv.y}});
      if (!pairs.back().uv.allFinite()) return {};
    }
  }
  std::ranges::sort(pairs, {}, &UvPoint::key);
  const auto repeated = std::ranges::unique(pairs, {}, &UvPoint::key);
  pairs.erase(repeated.begin(), repeated.end());
  return pairs;
}

std::optional<TextureMap> fit_map(const LeafMesh& leaf, std::span<const Vec2f> uvs,
                                  const Eigen::Vector3d& normal) {
  if (uvs.empty()) return {};
  const std::vector<UvPoint> pairs = uv_points(leaf, uvs, normal);
  if (pairs.empty()) return {};

  Eigen::Vector2d mean_uv = Eigen::Vector2d::Zero();
  Eigen::Vector3d mean_point = Eigen::Vector3d::Zero();
  Eigen::Array2d low = pairs.front().uv;
  Eigen::Array2d high = low;
  for (const auto& [point, uv] : pairs) {
    mean_uv += uv;
    mean_point += leaf.points[point];
    low = low.min(uv.array());
    high = high.max(uv.array());
  }
  mean_uv /= static_cast<double>(pairs.size());
  mean_point /= static_cast<double>(pairs.size());

  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Matrix<double, 3, 2> joint = Eigen::Matrix<double, 3, 2>::Zero();
  for (const auto& [point, uv] : pairs) {
    spread += (uv - mean_uv) * (uv - mean_uv).transpose();
    joint += (leaf.points[point] - mean_point) * (uv - mean_uv).transpose();
  }
  if (!(spread.determinant() > kLeastSpread * spread.trace() * spread.trace())) return {};

  TextureMap map{joint * spread.inverse(), {}, 0, {{low.x(), low.y()}, {high.x(), high.y()}}};
  map.origin = mean_point - map.linear * mean_uv;
  for (const auto& [point, uv] : pairs) {
    const Eigen::Vector3d image = mean_point + map.linear * (uv - mean_uv);
    map.residual = std::max(map.residual, (leaf.points[point] - image).norm());
  }
  return map;
}

/// Half the difference of the end points of the two diameters. Source: Eqs. (5), (6).
std::optional<LeafEllipse> map_ellipse(const TextureEllipse& drawn, const TextureMap& map,
                                       const PlaneFit& plane) {
  Eigen::Vector3d major = map.linear * Eigen::Vector2d(drawn.a.x, drawn.a.y);
  Eigen::Vector3d minor = map.linear * Eigen::Vector2d(drawn.b.x, drawn.b.y);
  if (minor.norm() > major.norm()) std::swap(major, minor);
  const double sine_scale = major.norm() * minor.norm();
  if (!(major.cross(minor).norm() > kLeastSine * sine_scale)) return {};
  const bool flat = std::max(plane.deviation, map.residual) <= major.norm() / 4;
  return LeafEllipse{plane.normal, major, minor, flat, true, map};
}

}  // namespace

std::optional<LeafEllipse> fit_ellipse(const LeafMesh& leaf, const TextureSource& texture) {
  const std::optional<PlaneFit> plane = fit_plane(leaf);
  if (!plane) return {};
  std::optional<TextureMap> map;
  if (texture.draws()) {
    map = fit_map(leaf, texture.uvs, plane->normal);
    if (map) {
      const auto drawn = texture.ellipse ? texture.ellipse : texture.mask->ellipse(map->box);
      if (drawn) {
        if (auto mapped = map_ellipse(*drawn, *map, *plane)) return mapped;
      }
    }
  }
  const bool flat = plane->deviation <= plane->major.norm() / 4;
  return LeafEllipse{plane->normal, plane->major, plane->minor, flat, false, map};
}

}  // namespace leafhull
