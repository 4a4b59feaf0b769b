// SPDX-License-Identifier: Apache-2.0
#include "leaves/collect_leaves.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "leaves/frame.h"
#include "leaves/leaf_mesh.h"
#include "leaves/placement.h"
#include "leaves/solids.h"

namespace leafhull {
namespace {

/// Components with fewer faces, such as needles, are not tested for being solid.
constexpr std::size_t kFewestFacesOfSolid = 8;

/// The number of components in a batch: few enough for their leaves to stay in the cache until they
/// are appended.
constexpr std::size_t kAtATime = 1 << 13;

/// Takes components one after the other, numbered through all instances.
class LeafCollector {
 public:
  /// `before`: the leaves that were found before, which do not change meanwhile.
  LeafCollector(const LeafSource& source, const FoundLeaves& before)
      : found{.sheets = SheetCollector(&before.sheets)}, source_(source), before_(before) {}
  LeafCollector(const LeafCollector& other, tbb::split)
      : LeafCollector(other.source_, other.before_) {}
  void join(LeafCollector& next) { found.append(std::move(next.found)); }

  void operator()(const tbb::blocked_range<std::size_t>& numbers) {
    for (std::size_t number = numbers.begin(); number != numbers.end(); ++number) {
      const std::size_t instance = number / source_.components.size();
      if (instance != instance_) {
        instance_ = instance;
        placement_ = Placement(source_.to_world[instance]);
      }
      take_component(source_.components[number % source_.components.size()]);
    }
  }

  FoundLeaves found;

 private:
  void take_component(std::span<const Face> component) {
    if (component.size() >= kFewestFacesOfSolid) {
      mesh_.assign(source_.mesh, component, placement_.linear);
      const std::vector<EigenTriangle> closed = closed_surface(mesh_);
      if (!closed.empty()) found.sheets.begin_solid(closed, first_point());
    }
    if (!take_if_flat(component)) {
      ++found.split;
      take_pieces(component);
    }
    found.sheets.end_solid();
  }

  void take_pieces(std::span<const Face> component) {
    const FaceGroups pieces = split_at_sharp_edges(mesh_);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].size() < component.size() && take_if_flat(pieces[i])) continue;
      const FaceGroups triangles = split_into_triangles(pieces[i]);
      for (std::size_t t = 0; t < triangles.size(); ++t) take_triangle(triangles[t]);
    }
  }

  /// Returns false, with the faces in `mesh_`, if they are not one flat leaf.
  bool take_if_flat(std::span<const Face> faces) {
    mesh_.assign(source_.mesh, faces, placement_.linear);
    const std::optional<LeafEllipse> ellipse = fit_ellipse(mesh_, source_.texture);
    if (ellipse && !ellipse->flat) return false;
    take_mesh(ellipse, false);
    return true;
  }

  void take_triangle(std::span<const Face> faces) {
    mesh_.assign(source_.mesh, faces, placement_.linear);
    take_mesh(fit_ellipse(mesh_, source_.texture), true);
  }

  void take_mesh(const std::optional<LeafEllipse>& ellipse, bool piece) {
    if (!ellipse || !is_finite() || !append_vertices(*ellipse)) {
      ++found.dropped;
      return;
    }
    found.sheets.take(mesh_, *ellipse, source_.texture, first_point(), source_.scale, piece);
    ++found.count;
    if (source_.texture.draws() && !ellipse->from_texture) ++found.untextured;
  }

  /// The first point of `mesh_` in the world.
  Eigen::Vector3d first_point() const {
    const Eigen::Vector3d first = to_eigen(source_.mesh.positions[mesh_.positions.front()]);
    return placement_.linear * first + placement_.translation;
  }

  /// Whether all normals and texture coordinates in `mesh_` are finite.
  bool is_finite() const {
    const std::vector<Vec3f>& normals = source_.primitive.normals;
    const std::vector<Vec2f>& uvs = source_.primitive.uvs;
    return std::ranges::all_of(mesh_.faces, [&](const Face& face) {
      return std::ranges::all_of(face.vertex, [&](std::uint32_t vertex) {
        return (normals.empty() || to_eigen(normals[vertex]).allFinite()) &&
               (uvs.empty() || (std::isfinite(uvs[vertex].x) && std::isfinite(uvs[vertex].y)));
      });
    });
  }

  /// Appends one kernel frame per vertex, or nothing if a value does not fit in a float.
  bool append_vertices(const LeafEllipse& ellipse) {
    const auto radius_major = static_cast<float>(source_.scale * ellipse.major.norm());
    const auto radius_minor = static_cast<float>(source_.scale * ellipse.minor.norm());
    if (!(radius_minor > 0) || !std::isfinite(radius_major)) return false;
    const auto number = static_cast<std::uint32_t>(found.count);
    const std::size_t before = found.vertices.size();
    const std::vector<Eigen::Vector3d> normals =
        vertex_normals(mesh_, source_.primitive.normals, placement_, ellipse.normal);
    for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
      const Eigen::Vector3d local = to_eigen(source_.mesh.positions[mesh_.positions[i]]);
      const Eigen::Vector3d world = placement_.linear * local + placement_.translation;
      const Eigen::Vector3d major = major_direction(ellipse, normals[i]);
      if (!world.allFinite() || !normals[i].allFinite() || !major.allFinite()) {
        found.vertices.resize(before);
        return false;
      }
      found.vertices.push_back({to_vec3d(world), to_vec3f(normals[i]), to_vec3f(major),
                                radius_major, radius_minor, number});
    }
    for (std::size_t i = before; i < found.vertices.size(); ++i) {
      found.bounds.include(found.vertices[i].position);
    }
    return true;
  }

  const LeafSource& source_;
  const FoundLeaves& before_;
  std::size_t instance_ = ~std::size_t{0};
  Placement placement_{kIdentity};
  LeafMesh mesh_;
};

}  // namespace

void FoundLeaves::append(FoundLeaves&& next) {
  if (!next.vertices.empty()) {
    bounds.include(next.bounds.low);
    bounds.include(next.bounds.high);
  }
  const auto before = static_cast<std::uint32_t>(count);
  for (LeafVertex& vertex : next.vertices) vertex.leaf += before;
  vertices.insert(vertices.end(), next.vertices.begin(), next.vertices.end());
  next.vertices = {};
  sheets.append(std::move(next.sheets));
  count += next.count;
  dropped += next.dropped;
  split += next.split;
  untextured += next.untextured;
}

void collect_leaves(const LeafSource& source, FoundLeaves& found) {
  const std::size_t count = source.to_world.size() * source.components.size();
  for (std::size_t begin = 0; begin < count; begin += kAtATime) {
    LeafCollector collector(source, found);
    tbb::parallel_reduce(tbb::blocked_range<std::size_t>(begin, std::min(begin + kAtATime, count)),
                         collector);
    found.append(std::move(collector.found));
  }
}

}  // namespace leafhull
