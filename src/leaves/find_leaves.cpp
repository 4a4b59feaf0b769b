// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include "leafhull/error.h"
#include "leafhull/leaves.h"
#include "leaves/alpha_mask.h"
#include "leaves/components.h"
#include "leaves/crown.h"
#include "leaves/ellipse.h"
#include "leaves/frame.h"
#include "leaves/leaf_mesh.h"
#include "leaves/order.h"
#include "leaves/placement.h"
#include "leaves/sheets.h"

namespace leafhull {
namespace {

void check(const LeafOptions& options) {
  if (!(options.scale > 0) || !std::isfinite(options.scale)) {
    throw Error(ErrorCode::usage, "--leaf-scale is not a positive number",
                "Give the factor for the leaves' radii, 1 to leave them.");
  }
  if (!options.ellipse) return;
  const auto& [centre, a, b] = *options.ellipse;
  const double area = a.x * b.y - a.y * b.x;
  if (!std::isfinite(area) || !std::isfinite(centre.x + centre.y) || area == 0) {
    throw Error(ErrorCode::usage, "--ellipse has half axes along one line or of no length",
                "Give cu,cv,au,av,bu,bv: its centre and two half axes in texture space.");
  }
}

/// Needles of fewer faces are not looked at.
constexpr std::size_t kFewestFacesOfSolid = 8;

/// Takes the leaves of one placed primitive after the other.
class LeafCollector {
 public:
  LeafCollector(const TreeModel& tree, const LeafChoice& choice, const LeafOptions& options,
                LeafSet& leaves)
      : tree_(tree), choice_(choice), options_(options), leaves_(leaves) {}

  /// Places `mesh`, which is `primitive` welded, and takes its components.
  void take(const Primitive& primitive, const WeldedMesh& mesh, const FaceGroups& components,
            const Transform& to_world) {
    const Source source{primitive, mesh, Placement(to_world), texture_of(primitive)};
    for (std::size_t i = 0; i < components.size(); ++i) take_component(source, components[i]);
  }

  /// Leaves whose texture should have told their ellipse and did not.
  std::size_t untextured() const { return untextured_; }
  /// The leaves as visible area.
  std::shared_ptr<const LeafSheets> sheets(const Box& crown) { return sheets_.finish(crown); }
  /// Materials whose texture is cut away everywhere, by name.
  const std::vector<std::string>& hidden() const { return hidden_; }

 private:
  struct Source {
    const Primitive& primitive;
    const WeldedMesh& mesh;
    Placement placement;
    TextureSource texture;
  };

  TextureSource texture_of(const Primitive& primitive) {
    TextureSource source{primitive.uvs, options_.ellipse, nullptr};
    if (primitive.material < 0) return source;
    const auto [known, is_new] = masks_.try_emplace(primitive.material);
    if (is_new) known->second = mask_of(static_cast<std::size_t>(primitive.material));
    source.mask = known->second;
    return source;
  }

  std::shared_ptr<AlphaMask> mask_of(std::size_t number) {
    const Material& material = tree_.materials[number];
    const bool cut_out = number < choice_.cut_out.size() && choice_.cut_out[number];
    std::optional<AlphaMask> mask = AlphaMask::of(material, tree_.images, cut_out);
    if (!mask) return nullptr;
    if (!mask->keeps_any()) {
      hidden_.push_back(material.name);
      return nullptr;
    }
    return std::make_shared<AlphaMask>(std::move(*mask));
  }

  void take_component(const Source& source, std::span<const Face> component) {
    if (component.size() >= kFewestFacesOfSolid) {
      mesh_.assign(source.mesh, component, source.placement.linear);
      const std::vector<EigenTriangle> closed = closed_surface(mesh_);
      if (!closed.empty()) sheets_.begin_solid(closed, first_point(source));
    }
    if (!take_if_flat(source, component)) {
      ++leaves_.split_components;
      take_pieces(source, component);
    }
    sheets_.end_solid();
  }

  void take_pieces(const Source& source, std::span<const Face> component) {
    const FaceGroups pieces = split_at_sharp_edges(mesh_);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].size() < component.size() && take_if_flat(source, pieces[i])) continue;
      const FaceGroups triangles = split_into_triangles(pieces[i]);
      for (std::size_t t = 0; t < triangles.size(); ++t) take_triangle(source, triangles[t]);
    }
  }

  /// False, and `mesh_` holds the faces, where they are not one flat leaf.
  bool take_if_flat(const Source& source, std::span<const Face> faces) {
    mesh_.assign(source.mesh, faces, source.placement.linear);
    const std::optional<LeafEllipse> ellipse = fit_ellipse(mesh_, source.texture);
    if (ellipse && !ellipse->flat) return false;
    take_mesh(source, ellipse, false);
    return true;
  }

  void take_triangle(const Source& source, std::span<const Face> faces) {
    mesh_.assign(source.mesh, faces, source.placement.linear);
    take_mesh(source, fit_ellipse(mesh_, source.texture), true);
  }

  void take_mesh(const Source& source, const std::optional<LeafEllipse>& ellipse, bool piece) {
    if (!ellipse || !is_finite(source.primitive) || !append_vertices(source, *ellipse)) {
      ++leaves_.dropped_leaves;
      return;
    }
    sheets_.take(mesh_, *ellipse, source.texture, first_point(source), options_.scale, piece);
    ++leaves_.leaf_count;
    if (source.texture.draws() && !ellipse->from_texture) ++untextured_;
  }

  /// Of `mesh_`, in the world.
  Eigen::Vector3d first_point(const Source& source) const {
    const Eigen::Vector3d first = to_eigen(source.mesh.positions[mesh_.positions.front()]);
    return source.placement.linear * first + source.placement.translation;
  }

  /// Whether every normal and texture coordinate that `mesh_` stores is.
  bool is_finite(const Primitive& primitive) const {
    return std::ranges::all_of(mesh_.faces, [&](const Face& face) {
      return std::ranges::all_of(face.vertex, [&](std::uint32_t vertex) {
        return (primitive.normals.empty() || to_eigen(primitive.normals[vertex]).allFinite()) &&
               (primitive.uvs.empty() ||
                (std::isfinite(primitive.uvs[vertex].x) && std::isfinite(primitive.uvs[vertex].y)));
      });
    });
  }

  /// One kernel frame a vertex, or nothing where a value has no place in a float.
  bool append_vertices(const Source& source, const LeafEllipse& ellipse) {
    const auto radius_major = static_cast<float>(options_.scale * ellipse.major.norm());
    const auto radius_minor = static_cast<float>(options_.scale * ellipse.minor.norm());
    if (!(radius_minor > 0) || !std::isfinite(radius_major)) return false;
    const auto number = static_cast<std::uint32_t>(leaves_.leaf_count);
    const std::size_t before = leaves_.vertices.size();
    const std::vector<Eigen::Vector3d> normals =
        vertex_normals(mesh_, source.primitive.normals, source.placement, ellipse.normal);
    for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
      const Eigen::Vector3d local = to_eigen(source.mesh.positions[mesh_.positions[i]]);
      const Eigen::Vector3d world = source.placement.linear * local + source.placement.translation;
      const Eigen::Vector3d major = major_direction(ellipse, normals[i]);
      if (!world.allFinite() || !normals[i].allFinite() || !major.allFinite()) {
        leaves_.vertices.resize(before);
        return false;
      }
      leaves_.vertices.push_back({{world.x(), world.y(), world.z()},
                                  to_vec3f(normals[i]),
                                  to_vec3f(major),
                                  radius_major,
                                  radius_minor,
                                  number});
    }
    return true;
  }

  const TreeModel& tree_;
  const LeafChoice& choice_;
  const LeafOptions& options_;
  LeafSet& leaves_;
  LeafMesh mesh_;
  std::map<int, std::shared_ptr<AlphaMask>> masks_;  ///< by material
  std::vector<std::string> hidden_;
  SheetCollector sheets_;
  std::size_t untextured_ = 0;
};

std::string untextured_warning(std::size_t count) {
  const std::string why = " no usable texture coordinates or nothing of the texture; ";
  if (count == 1) return "1 leaf has" + why + "its ellipse is that of its triangles";
  return std::to_string(count) + " leaves have" + why +
         "their ellipses are those of their triangles";
}

std::string invisible_warning(std::size_t count) {
  if (count == 1) return "1 leaf shows nothing of its texture that is not transparent";
  return std::to_string(count) + " leaves show nothing of their texture that is not transparent";
}

std::string no_usable_leaf(std::size_t dropped, const std::string& file) {
  const std::string which =
      dropped == 1 ? "the one leaf of " + file + " does not have"
                   : "none of the " + std::to_string(dropped) + " leaves of " + file + " has";
  return which + " an area and finite values";
}

/// R_u once a leaf, in the order of the leaves' numbers.
double mean_radius_major(const LeafSet& leaves) {
  double sum = 0;
  std::uint32_t next = 0;
  for (const LeafVertex& vertex : leaves.vertices) {
    if (vertex.leaf < next) continue;
    sum += vertex.radius_major;
    ++next;
  }
  return sum / static_cast<double>(leaves.leaf_count);
}

}  // namespace

LeafSet find_leaves(const TreeModel& tree, std::span<const Instance> instances,
                    const LeafChoice& choice, const LeafOptions& options) {
  check(options);
  LeafSet leaves;
  leaves.choice = std::make_shared<const LeafChoice>(choice);
  leaves.colour = choice.colour;
  leaves.warnings = choice.warnings;
  std::vector<std::uint32_t> selected(instances.size());
  std::iota(selected.begin(), selected.end(), 0u);
  std::erase_if(selected, [&](std::uint32_t i) { return !choice.instances[i]; });
  std::ranges::stable_sort(selected, {}, [&](auto i) { return instances[i].primitive; });

  LeafCollector collector(tree, choice, options, leaves);
  for (auto first = selected.begin(); first != selected.end();) {
    const std::uint32_t index = instances[*first].primitive;
    const Primitive& primitive = tree.primitives[index];
    const WeldedMesh mesh = weld(primitive, choice.triangles[index]);
    const FaceGroups components = connected_components(mesh);
    for (; first != selected.end() && instances[*first].primitive == index; ++first) {
      collector.take(primitive, mesh, components, instances[*first].to_world);
    }
  }
  if (leaves.vertices.empty()) {
    throw Error(ErrorCode::input, no_usable_leaf(leaves.dropped_leaves, tree.path.string()),
                "Look at the model with leafhull inspect, or choose other leaves with --leaves.");
  }
  if (collector.untextured() > 0) {
    leaves.warnings.push_back(untextured_warning(collector.untextured()));
  }
  for (const std::string& material : collector.hidden()) {
    leaves.warnings.push_back(
        "the texture of material '" + material +
        "' is transparent everywhere; its leaves are taken as whole triangles");
  }
  for (const LeafVertex& vertex : leaves.vertices) leaves.bounds.include(vertex.position);
  const Crown crown = find_crown(leaves);
  leaves.crown = crown.box;
  leaves.stray_leaves = crown.strays;
  if (crown.strays > 0) leaves.warnings.push_back(stray_warning(crown));
  sort_vertices(leaves);
  leaves.sheets = collector.sheets(leaves.crown);
  leaves.area = leaves.sheets->area;
  if (const std::size_t invisible = leaves.sheets->invisible; invisible > 0) {
    leaves.warnings.push_back(invisible_warning(invisible));
  }
  leaves.mean_radius_major = mean_radius_major(leaves);
  return leaves;
}

}  // namespace leafhull
