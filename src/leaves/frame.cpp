// SPDX-License-Identifier: Apache-2.0
#include "leaves/frame.h"

#include <algorithm>
#include <tuple>

namespace leafhull {
namespace {

// Below this length, the remainder of unit vectors is round-off.
constexpr double kRoundOff = 1e-6;

/// A stored normal at a point of the leaf, turned to the front.
struct PointNormal {
  std::uint32_t point;
  Vec3f normal;

  auto key() const { return std::tie(point, normal.x, normal.y, normal.z); }
};

Eigen::Vector3d turned_to(const Eigen::Vector3d& front, const Eigen::Vector3d& v) {
  return v.dot(front) < 0 ? Eigen::Vector3d(-v) : v;
}

std::vector<PointNormal> distinct_normals(const LeafMesh& leaf, std::span<const Vec3f> stored,
                                          const Placement& placement,
                                          const Eigen::Vector3d& plane_normal) {
  std::vector<PointNormal> normals;
  if (stored.empty()) return normals;
  normals.reserve(3 * leaf.faces.size());
  // A placed normal points to the front if the stored one points along this.
  const Eigen::Vector3d front = placement.normals.transpose() * plane_normal;
  for (std::size_t face = 0; face < leaf.faces.size(); ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3f& n = stored[leaf.faces[face].vertex[corner]];
      normals.push_back({leaf.triangles[face][corner], to_eigen(n).dot(front) < 0 ? -n : n});
    }
  }
  std::ranges::sort(normals, {}, &PointNormal::key);
  const auto repeated = std::ranges::unique(normals, {}, &PointNormal::key);
  normals.erase(repeated.begin(), repeated.end());
  return normals;
}

/// Scales `sums` to unit length; those that are too short become zero.
/// Returns whether all are unit vectors.
bool normalize(std::vector<Eigen::Vector3d>& sums, double least_length) {
  bool all = true;
  for (Eigen::Vector3d& sum : sums) {
    if (sum.norm() > least_length) {
      sum.normalize();
    } else {
      sum.setZero();
      all = false;
    }
  }
  return all;
}

std::vector<Eigen::Vector3d> face_normals(const LeafMesh& leaf,
                                          const Eigen::Vector3d& plane_normal) {
  std::vector<Eigen::Vector3d> sums(leaf.points.size(), Eigen::Vector3d::Zero());
  double largest = 0;
  for (std::size_t face = 0; face < leaf.faces.size(); ++face) {
    const Eigen::Vector3d area = turned_to(plane_normal, leaf.areas[face]);
    largest = std::max(largest, area.norm());
    for (const std::uint32_t point : leaf.triangles[face]) sums[point] += area;
  }
  normalize(sums, kRoundOff * largest);
  return sums;
}

}  // namespace

std::vector<Eigen::Vector3d> vertex_normals(const LeafMesh& leaf, std::span<const Vec3f> stored,
                                            const Placement& placement,
                                            const Eigen::Vector3d& plane_normal) {
  std::vector<Eigen::Vector3d> normals(leaf.points.size(), Eigen::Vector3d::Zero());
  for (const auto& [point, normal] : distinct_normals(leaf, stored, placement, plane_normal)) {
    normals[point] += (placement.normals * to_eigen(normal)).normalized();
  }
  if (normalize(normals, kRoundOff)) return normals;

  const std::vector<Eigen::Vector3d> fallback = face_normals(leaf, plane_normal);
  for (std::size_t point = 0; point < normals.size(); ++point) {
    if (!normals[point].isZero(0)) continue;
    normals[point] = fallback[point].isZero(0) ? plane_normal : fallback[point];
  }
  return normals;
}

Eigen::Vector3d major_direction(const LeafEllipse& ellipse, const Eigen::Vector3d& normal) {
  const auto orthogonal = [&](const Eigen::Vector3d& axis) -> Eigen::Vector3d {
    return axis.normalized() - normal.dot(axis.normalized()) * normal;
  };
  const Eigen::Vector3d major = orthogonal(ellipse.major);
  if (major.norm() > kRoundOff) return major.normalized();
  return orthogonal(ellipse.minor).cross(normal).normalized();
}

}  // namespace leafhull
