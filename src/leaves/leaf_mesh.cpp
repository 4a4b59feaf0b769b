// SPDX-License-Identifier: Apache-2.0
#include "leaves/leaf_mesh.h"

#include <algorithm>

#include "leaves/placement.h"

namespace leafhull {
namespace {

// A ratio of standard deviations below this is the round-off of a ratio of variances.
constexpr double kLeastRatio = 1e-7;

std::array<Eigen::Vector3d, 3> corners(const LeafMesh& leaf, std::size_t face) {
  const auto [a, b, c] = leaf.triangles[face];
  return {leaf.points[a], leaf.points[b], leaf.points[c]};
}

Eigen::Vector3d centroid(const LeafMesh& leaf, double total_area) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t face = 0; face < leaf.faces.size(); ++face) {
    const auto [a, b, c] = corners(leaf, face);
    sum += leaf.areas[face].norm() / 3 * (a + b + c);
  }
  return sum / total_area;
}

/// The integral of x x^T over a triangle with corners a, b, c and s = a + b + c is
/// area / 12 * (a a^T + b b^T + c c^T + s s^T).
Eigen::Matrix3d covariance(const LeafMesh& leaf, double total_area, const Eigen::Vector3d& centre) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t face = 0; face < leaf.faces.size(); ++face) {
    auto [a, b, c] = corners(leaf, face);
    a -= centre;
    b -= centre;
    c -= centre;
    const Eigen::Vector3d s = a + b + c;
    sum += leaf.areas[face].norm() / 12 *
           (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
  return sum / total_area;
}

}  // namespace

void LeafMesh::assign(const WeldedMesh& mesh, std::span<const Face> leaf_faces,
                      const Eigen::Matrix3d& linear) {
  faces = leaf_faces;
  positions.clear();
  for (const Face& face : faces) {
    positions.insert(positions.end(), face.position.begin(), face.position.end());
  }
  std::ranges::sort(positions);
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());

  points.clear();
  const Eigen::Vector3d first = to_eigen(mesh.positions[positions.front()]);
  for (const std::uint32_t position : positions) {
    points.push_back(linear * (to_eigen(mesh.positions[position]) - first));
  }
  const auto point_of = [&](std::uint32_t position) {
    const auto found = std::ranges::lower_bound(positions, position);
    return static_cast<std::uint32_t>(found - positions.begin());
  };
  triangles.clear();
  areas.clear();
  for (const Face& face : faces) {
    const auto [a, b, c] = face.position;
    const auto& triangle =
        triangles.emplace_back(std::array{point_of(a), point_of(b), point_of(c)});
    const Eigen::Vector3d& origin = points[triangle[0]];
    areas.push_back((points[triangle[1]] - origin).cross(points[triangle[2]] - origin) / 2);
  }
}

std::optional<PlaneFit> fit_plane(const LeafMesh& leaf) {
  double area = 0;
  for (const Eigen::Vector3d& a : leaf.areas) area += a.norm();
  if (!(area > 0)) return std::nullopt;
  const Eigen::Vector3d centre = centroid(leaf, area);
  const Eigen::Matrix3d moments = covariance(leaf, area, centre);
  if (!moments.allFinite()) return std::nullopt;

  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(moments);
  const Eigen::Vector3d deviations = principal.eigenvalues().cwiseMax(0).cwiseSqrt();
  if (!(deviations[1] > kLeastRatio * deviations[2])) return std::nullopt;

  PlaneFit plane;
  plane.normal = principal.eigenvectors().col(0);
  if (plane.normal.dot(leaf.areas.front()) < 0) plane.normal = -plane.normal;
  plane.major = 2 * deviations[2] * principal.eigenvectors().col(2);
  plane.minor = 2 * deviations[1] * principal.eigenvectors().col(1);
  plane.deviation = 0;
  for (const Eigen::Vector3d& point : leaf.points) {
    plane.deviation = std::max(plane.deviation, std::abs(plane.normal.dot(point - centre)));
  }
  return plane;
}

}  // namespace leafhull
