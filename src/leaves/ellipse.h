// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>

#include "leaves/alpha_mask.h"
#include "leaves/leaf_mesh.h"

namespace leafhull {

/// Where the ellipses of a primitive's leaves may be drawn in texture space; neither: their
/// triangles alone decide.
struct TextureSource {
  std::span<const Vec2f> uvs;             ///< by stored vertex, or none
  std::optional<TextureEllipse> ellipse;  ///< given by the user
  AlphaMask* mask = nullptr;

  bool draws() const { return ellipse || mask; }
};

/// A leaf's ellipse and plane in world directions.
struct LeafEllipse {
  Eigen::Vector3d normal;        ///< of the leaf's plane, unit
  Eigen::Vector3d major, minor;  ///< half axes, not both along one line; major is the longer one
  bool flat;  ///< no farther than a quarter of R_u from its plane and texture map
  bool from_texture;
};

/// The first source that applies: the given ellipse, the alpha mask, the triangles. Nothing for a
/// leaf without area or with values that are not finite. SPEC: 1, "The leaf's ellipse".
std::optional<LeafEllipse> fit_ellipse(const LeafMesh& leaf, const TextureSource& texture);

}  // namespace leafhull
