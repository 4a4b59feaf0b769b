// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "leaves/leaf_components.h"

namespace leafhull {

/// The triangles of a possible leaf, in world directions and scale but relative to its first
/// vertex, so that it loses no digits far from the origin. It is reused to save memory.
struct LeafMesh {
  std::span<const Face> faces;
  std::vector<std::uint32_t> positions;                 ///< into WeldedMesh::positions, ascending
  std::vector<Eigen::Vector3d> points;                  ///< one per position
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< one per face, into `points`
  std::vector<Eigen::Vector3d> areas;                   ///< one per face, its area times its normal

  void assign(const WeldedMesh& mesh, std::span<const Face> leaf_faces,
              const Eigen::Matrix3d& linear);
};

/// The plane through a leaf and the ellipse with the second moments of its area.
struct PlaneFit {
  Eigen::Vector3d normal;        ///< unit; on the front side of the leaf's first face
  Eigen::Vector3d major, minor;  ///< half axes: two standard deviations of the area
  double deviation;              ///< largest distance of a vertex to the plane
};

/// A least-squares fit over the leaf's area. None if it has no area or is not finite.
std::optional<PlaneFit> fit_plane(const LeafMesh& leaf);

}  // namespace leafhull
