// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "leaves/ellipse.h"
#include "leaves/leaf_mesh.h"
#include "leaves/placement.h"

namespace leafhull {

/// A unit normal for every point of the leaf, on the front side of its plane: the mean of the
/// distinct normals stored there, else of those of the faces around it, else the plane's.
/// `stored` has the normals by stored vertex, or none.
std::vector<Eigen::Vector3d> vertex_normals(const LeafMesh& leaf, std::span<const Vec3f> stored,
                                            const Placement& placement,
                                            const Eigen::Vector3d& plane_normal);

/// The direction u_j: the major axis made orthogonal to the unit normal by Gram-Schmidt.
Eigen::Vector3d major_direction(const LeafEllipse& ellipse, const Eigen::Vector3d& normal);

}  // namespace leafhull
