// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <span>

#include "leaves/alpha_mask.h"
#include "leaves/leaf_mesh.h"

namespace leafhull {

/// Where the ellipses of a primitive's leaves may come from in texture space. With neither an
/// ellipse nor a mask, their triangles alone decide.
struct TextureSource {
  std::span<const Vec2f> uvs;             ///< by stored vertex, or none
  std::optional<TextureEllipse> ellipse;  ///< given by the user
  std::shared_ptr<AlphaMask> mask;        ///< the visible part of the texture; none: all of it

  bool draws() const { return ellipse || mask; }
};

/// The least-squares affine map from a leaf's texture coordinates to its points: origin + linear
/// uv.
struct TextureMap {
  Eigen::Matrix<double, 3, 2> linear;
  Eigen::Vector3d origin;
  double residual;  ///< the largest distance between a point and its image
  UvBox box;        ///< of the leaf's texture coordinates
};

/// A leaf's ellipse and plane in world directions.
struct LeafEllipse {
  Eigen::Vector3d normal;        ///< of the leaf's plane, unit
  Eigen::Vector3d major, minor;  ///< half axes, not both along one line; major is the longer one
  bool flat;  ///< no farther than a quarter of R_u from its plane and texture map
  bool from_texture;
  std::optional<TextureMap> map;  ///< where the texture can be mapped
};

/// A leaf's ellipse from the first source that applies: the given ellipse, the alpha mask, the
/// triangles. None for a leaf without area or with values that are not finite. SPEC: 1, "The leaf's
/// ellipse".
std::optional<LeafEllipse> fit_ellipse(const LeafMesh& leaf, const TextureSource& texture);

}  // namespace leafhull
