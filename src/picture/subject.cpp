// SPDX-License-Identifier: Apache-2.0
// Turns trees, shapes and densities into subjects for rays.
#include <algorithm>
#include <cmath>
#include <utility>

#include "foliage/rest.h"
#include "leafhull/error.h"
#include "leafhull/render.h"
#include "picture/parts.h"
#include "pipeline/finish_mesh.h"
#include "render/frame.h"
#include "render/light.h"
#include "surface/metrics.h"
#include "surface/polygonise.h"
#include "surface/read_field.h"

namespace leafhull {
namespace {

using Parts = Subject::Parts;
using Surfaces = std::vector<std::shared_ptr<const render::Surface>>;

constexpr std::string_view kShapeName = "abstract shape";

/// Gives the parts their place in a scene about 1 large.
void place(const Frame& frame, Parts& parts) {
  const Box box = render::box_of(frame);
  if (!(box.longest_side() > 0)) {
    throw Error(ErrorCode::input, "the subject has no extent", "Repair the model.");
  }
  parts.placement = {(box.low + box.high) / 2, 1 / box.longest_side()};
  parts.points.reserve(frame.points.size());
  for (const Vec3d p : frame.points) parts.points.push_back(parts.placement(p));
  parts.reach = static_cast<float>(frame.reach * parts.placement.scale);
}

/// The last step sets up what rays meet.
Subject finish(std::shared_ptr<Parts> parts, const Surfaces& surfaces) {
  if (!surfaces.empty()) {
    parts->scene.emplace(parts->embree.get(), surfaces);
    parts->triangles.emplace(*parts->scene);
    parts->targets.push_back(&*parts->triangles);
  }
  if (parts->density) {
    parts->targets.push_back(&*parts->density);
  } else {
    parts->mesh_surroundings.emplace(parts->targets);
  }
  return Subject(std::move(parts));
}

/// Makes surfaces of a part of a tree. `cut_out` is LeafChoice's, or empty.
void add(const TreePart& part, render::Look look, const std::vector<bool>& cut_out, Parts& parts,
         Surfaces& surfaces) {
  for (const Instance& instance : part.instances) {
    const int material = part.model->primitives[instance.primitive].material;
    const bool holes = material >= 0 && !cut_out.empty() && cut_out[material];
    surfaces.push_back(render::make_surface(parts.embree.get(), *part.model, instance, look,
                                            parts.placement, holes));
  }
  parts.models.push_back(part.model);
}

/// One card for each leaf, at the middle of its vertices, known by its index in the file: cards do
/// not depend on how a moving tree sorts its leaves.
std::vector<LeafCard> cards_of(const LeafSet& leaves, const render::Placement& placement) {
  struct Sum {
    Vec3d positions, normals, majors;
    double count = 0;
    const LeafVertex* any = nullptr;
  };
  std::vector<Sum> sums(leaves.leaf_count);
  for (const LeafVertex& vertex : leaves.vertices) {
    Sum& sum = sums[leaves.order_in_file.empty() ? vertex.leaf : leaves.order_in_file[vertex.leaf]];
    if (!sum.any) sum.any = &vertex;
    // Axes are known only up to their signs.
    const auto along = [](Vec3f axis, Vec3f first) {
      return Vec3d(dot(axis, first) < 0 ? -axis : axis);
    };
    sum.positions = sum.positions + vertex.position;
    sum.normals = sum.normals + along(vertex.normal, sum.any->normal);
    sum.majors = sum.majors + along(vertex.major, sum.any->major);
    ++sum.count;
  }
  std::vector<LeafCard> cards;
  for (std::size_t leaf = 0; leaf < sums.size(); ++leaf) {
    const Sum& sum = sums[leaf];
    if (!sum.any) continue;
    const Vec3d major = normalized(sum.majors);
    const Vec3d minor = normalized(cross(sum.normals, major));
    cards.push_back({placement(sum.positions / sum.count),
                     Vec3f(major * (sum.any->radius_major * placement.scale)),
                     Vec3f(minor * (sum.any->radius_minor * placement.scale)),
                     static_cast<std::uint32_t>(leaf)});
  }
  return cards;
}

/// Needles and fronds grow away from the stem, however their cards are cut. Cards that are not
/// slender themselves are turned in their own plane.
void point_outwards(LeafKind kind, std::vector<LeafCard>& cards) {
  constexpr float kSlender = 0.4f, kLeast = 0.3f, kDroop = 0.4f;
  Vec3d sum;
  for (const LeafCard& card : cards) sum = sum + Vec3d(card.centre);
  const Vec3f middle = Vec3f(sum / static_cast<double>(std::max<std::size_t>(cards.size(), 1)));
  for (LeafCard& card : cards) {
    const float major = length(card.half_major), minor = length(card.half_minor);
    if (!(minor > kSlender * major)) continue;
    Vec3f away = card.centre - middle;
    if (kind == LeafKind::needle) {
      away.y = 0;
      away = normalized(away) - Vec3f{0, kDroop, 0};
    }
    const Vec3f u = card.half_major / major, v = card.half_minor / minor;
    const Vec2f along{dot(normalized(away), u), dot(normalized(away), v)};
    const float part = std::hypot(along.x, along.y);
    if (part < kLeast) continue;
    const float c = along.x / part, s = along.y / part;
    card.half_major = (u * c + v * s) * std::hypot(major * c, minor * s);
    card.half_minor = (v * c - u * s) * std::hypot(major * s, minor * c);
  }
}

}  // namespace

void add_positions(const TreeModel& model, std::span<const Instance> instances, Frame& frame) {
  for (const Instance& instance : instances) {
    const std::vector<Vec3d> points = render::world_positions(model, instance);
    frame.points.insert(frame.points.end(), points.begin(), points.end());
  }
}

const Report* Subject::report() const { return parts_->report ? &*parts_->report : nullptr; }

Subject tree_subject(std::shared_ptr<const TreeModel> tree, const LeafSet& leaves,
                     const Options& options, Surfacing surfacing, Device& device,
                     const Progress& progress, const Frame& frame) {
  const ThreadLimit limit(device.threads());
  const auto parts = std::make_shared<Parts>();
  const std::shared_ptr<const TreeModel> whole = std::move(tree);
  const TreePart wood = rest_of(whole, *leaves.choice);
  parts->leaf_colour = leaves.colour;
  std::shared_ptr<const DirectSurface> direct;
  if (surfacing == Surfacing::direct) {
    direct = std::make_shared<const DirectSurface>(leaves, options, device, progress);
    parts->report = direct->report();
  } else {
    Shape shape = extract(leaves, options, device, progress, Detail::shape);
    parts->mesh = std::move(shape.mesh);
    parts->report = std::move(shape.report);
  }

  Frame all = frame;
  if (all.points.empty()) {
    all = frame_of(leaves, parts->report->radius_max_model);
    add_positions(*wood.model, wood.instances, all);
  }
  place(all, *parts);
  parts->leaves = cards_of(leaves, parts->placement);
  parts->leaf_kind = leaves.choice->kind;
  if (parts->leaf_kind != LeafKind::broad) point_outwards(parts->leaf_kind, parts->leaves);
  parts->crown_colours = CrownColours::of(*whole, leaves, parts->report->radius_max_model);

  parts->embree = render::open_embree();
  Surfaces surfaces;
  add(wood, render::Look::wood, {}, *parts, surfaces);
  if (direct) {
    parts->density.emplace(std::move(direct), parts->placement,
                           render::foliage_colour(leaves.colour));
  } else {
    surfaces.push_back(render::make_surface(parts->embree.get(), parts->mesh, parts->placement));
  }
  return finish(parts, surfaces);
}

Subject drawn_subject(const std::shared_ptr<const TreeModel>& tree, const LeafChoice& choice,
                      const Subject& like) {
  const auto parts = std::make_shared<Parts>();
  parts->as_drawn = true;
  parts->placement = like.parts().placement;
  parts->points = like.parts().points;
  parts->reach = like.parts().reach;
  parts->embree = render::open_embree();
  Surfaces surfaces;
  add(rest_of(tree, choice), render::Look::wood, {}, *parts, surfaces);
  add(leaves_of(tree, choice), render::Look::leaf, choice.cut_out, *parts, surfaces);
  return finish(parts, surfaces);
}

Subject shape_subject(std::shared_ptr<const TreeModel> shape) {
  const auto parts = std::make_shared<Parts>();
  const TreeModel& model = *parts->models.emplace_back(std::move(shape));
  Frame frame;
  add_positions(model, model.instances, frame);
  place(frame, *parts);
  parts->embree = render::open_embree();
  Surfaces surfaces;
  for (const Instance& instance : model.instances) {
    if (model.primitives[instance.primitive].triangles.empty()) continue;
    if (!parts->leaf_colour) parts->leaf_colour = render::colour_of_shape(model, instance);
    surfaces.push_back(render::make_surface(parts->embree.get(), model, instance,
                                            render::Look::shape, parts->placement));
  }
  return finish(parts, surfaces);
}

bool is_shape(const TreeModel& file) {
  return std::ranges::all_of(file.instances, [&](const Instance& instance) {
    const Primitive& primitive = file.primitives[instance.primitive];
    const Material* material =
        primitive.material < 0 ? nullptr : &file.materials[primitive.material];
    const bool bare =
        primitive.mesh_name.empty() && instance.node_name.empty() &&
        (!material || (material->name.empty() && material->alpha_mode == AlphaMode::opaque));
    return bare || primitive.mesh_name == kShapeName;
  });
}

Subject field_subject(const std::filesystem::path& file, std::optional<double> threshold,
                      Surfacing surfacing, Device& device, const Progress& progress) {
  const ThreadLimit limit(device.threads());
  const auto parts = std::make_shared<Parts>();
  if (progress) progress({.stage = "read"});
  auto [read, origin] = read_field(file, threshold);
  const auto field = std::make_shared<const Field>(std::move(read));
  Frame frame{extent_of(*field), field->lattice().voxel_size};
  place(frame, *parts);
  parts->embree = render::open_embree();
  Surfaces surfaces;
  if (surfacing == Surfacing::direct) {
    parts->density.emplace(std::make_shared<const DirectSurface>(field, device), parts->placement,
                           render::foliage_colour(std::nullopt));
  } else {
    if (progress) progress({.stage = "polygonise"});
    parts->mesh = lattice_mesh(polygonise(*field, 0), field->lattice());
    surfaces.push_back(render::make_surface(parts->embree.get(), parts->mesh, parts->placement));
  }
  parts->placement.origin = parts->placement.origin + origin;  // for cameras in model units
  return finish(parts, surfaces);
}

}  // namespace leafhull
