// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "leafhull/shape.h"
#include "leafhull/tree.h"
#include "render/embree.h"
#include "render/placement.h"

namespace leafhull::render {

enum class Look { wood, leaf, shape };

/// Triangles ready for ray casting, in one or more scenes. The model that they were made from must
/// outlive them.
struct Surface {
  Look look = Look::shape;
  std::span<const Vec3f> vertices;  ///< placed; the geometry's own
  std::vector<Vec3f> normals;       ///< one per vertex, unit or zero; or none
  std::span<const Vec2f> uvs;       ///< one per vertex, or none
  std::span<const Vec3f> colors;    ///< one per vertex, linear, or none
  std::span<const std::array<std::uint32_t, 3>> triangles;
  Material material;
  const Image* image = nullptr;  ///< of the base colour
  GeometryHandle geometry;

  /// The texture coordinates at a point of a triangle, in Embree's barycentric coordinates.
  Vec2f uv(unsigned triangle, Vec2f at) const;
  /// The linear colour at that point.
  Vec3f color(unsigned triangle, Vec2f at) const;
  /// Whether the texture has a hole there.
  bool is_hole(Vec2f uv) const;
};

/// An instance of a tree, or of a shape that was read from a file.
/// @param cut_out the alpha of the image counts even if the material is opaque.
std::shared_ptr<const Surface> make_surface(RTCDevice device, const TreeModel& model,
                                            const Instance& instance, Look look,
                                            const Placement& placement, bool cut_out = false);

std::shared_ptr<const Surface> make_surface(RTCDevice device, const Mesh& mesh,
                                            const Placement& placement);

/// The base colour of a shape that was read from a file; none if it is grey, a program's default.
std::optional<Vec3f> colour_of_shape(const TreeModel& model, const Instance& instance);

/// The vertices of an instance in model space.
std::vector<Vec3d> world_positions(const TreeModel& model, const Instance& instance);

}  // namespace leafhull::render
