// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "foliage/crown_colours.h"
#include "leafhull/render.h"
#include "picture/density_target.h"
#include "render/embree.h"
#include "render/mesh_target.h"
#include "render/scene.h"
#include "render/surface.h"

namespace leafhull {

/// A leaf for brush strokes, in the scene.
struct LeafCard {
  Vec3f centre, half_major, half_minor;
  std::uint32_t leaf = 0;
};

/// All parts of a subject in its scene. Parts that refer to each other stay together.
struct Subject::Parts {
  std::optional<Report> report;  ///< of the extraction of a tree's shape
  render::Placement placement;
  std::vector<Vec3f> points;  ///< named viewpoints show these, with `reach` around each
  float reach = 0;
  std::vector<LeafCard> leaves;  ///< by leaf number
  LeafKind leaf_kind = LeafKind::broad;
  std::optional<Vec3f> leaf_colour;           ///< linear, mean; none: unknown
  std::optional<CrownColours> crown_colours;  ///< if colours differ

  bool as_drawn = false;  ///< a tree as its file draws it, never in watercolour

  std::vector<std::shared_ptr<const TreeModel>> models;  ///< of wood, leaves or a shape
  Mesh mesh;                                             ///< of foliage drawn as a mesh
  render::DeviceHandle embree;
  std::optional<render::Scene> scene;  ///< everything made of triangles
  std::optional<render::MeshTarget> triangles;
  std::optional<DensityTarget> density;
  std::vector<const render::Target*> targets;
  std::optional<render::MeshSurroundings> mesh_surroundings;

  const render::Surroundings& surroundings() const {
    if (density) return *density;
    return *mesh_surroundings;
  }
};

/// Adds the positions of these instances to what a picture must show.
void add_positions(const TreeModel& model, std::span<const Instance> instances, Frame& frame);

}  // namespace leafhull
