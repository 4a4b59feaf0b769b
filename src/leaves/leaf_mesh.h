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

/// The triangles of what may be a leaf, in world directions and scale but about its own first
/// vertex: far from the origin nothing is lost. Kept between leaves to reuse its memory.
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

/// Least squares over the leaf's area. Nothing where it has none or is not finite.
std::optional<PlaneFit> fit_plane(const LeafMesh& leaf);

}  // namespace leafhull
