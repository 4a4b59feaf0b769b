// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "leafhull/leaves.h"
#include "leaves/alpha_mask.h"
#include "leaves/ellipse.h"
#include "leaves/leaf_mesh.h"
#include "leaves/solids.h"

namespace leafhull {

/// The outline of leaves in two dimensions, and its visible part. Leaves that show the same part of
/// a texture, or have the same shape, share a chart.
struct LeafChart {
  std::vector<std::array<Vec2d, 3>> triangles;
  std::shared_ptr<const AlphaMask> mask;  ///< of the texture space they lie in; none: all visible
  std::vector<double> visible;            ///< the share of each triangle
  Vec2d centre;                           ///< of the visible part
};

/// A leaf: its chart, placed by position = origin + across x + along y, and its kernel's frame.
struct LeafSheet {
  Vec3d origin;
  Vec3d across, along;
  double area = 0;  ///< visible area, one side, model units squared; > 0
  std::uint32_t chart = 0;
  Vec3f normal, major;
  float radius_major = 0, radius_minor = 0;  ///< R_u, R_v, model units
  bool piece = false;       ///< a triangle of a curved surface: its ellipse is no leaf's
  std::int32_t solid = -1;  ///< the solid that it belongs to; -1: none

  Vec3d at(Vec2d p) const { return origin + across * p.x + along * p.y; }
};

/// The leaves of a tree as visible area, in an order that depends on the geometry alone.
struct LeafSet::Sheets {
  std::vector<LeafChart> charts;
  std::vector<LeafSheet> sheets;
  std::vector<LeafSolid> solids;  ///< with a volume and visible area
  std::size_t invisible = 0;      ///< leaves that have no visible area
  double area = 0;                ///< of all sheets
};

/// Takes leaves one by one.
class SheetCollector {
 public:
  /// Charts in `known` are not computed again; it must not change meanwhile.
  explicit SheetCollector(const SheetCollector* known = nullptr) : known_(known) {}

  /// `first`: where the leaf's first point lies in the world; `scale` multiplies its radii; `piece`
  /// as in LeafSheet.
  void take(const LeafMesh& leaf, const LeafEllipse& ellipse, const TextureSource& texture,
            const Eigen::Vector3d& first, double scale, bool piece);

  /// Leaves taken until end_solid() belong to this closed surface. `first` is as above.
  void begin_solid(std::span<const EigenTriangle> closed, const Eigen::Vector3d& first);
  void end_solid() { solid_ = -1; }

  /// Takes the leaves of `next` after its own.
  void append(SheetCollector&& next);

  /// Makes room for so many leaves.
  void reserve(std::size_t leaves) { sheets_->sheets.reserve(leaves); }

  /// All leaves, sorted. `crown` is the box without strays, which must not move other leaves.
  std::shared_ptr<const LeafSet::Sheets> finish(const Box& crown);

 private:
  using Triangles = std::vector<std::array<Vec2d, 3>>;
  using Charts = std::map<std::pair<const AlphaMask*, std::vector<double>>, std::uint32_t>;

  std::uint32_t chart_of(Triangles triangles, const std::shared_ptr<AlphaMask>& mask);
  LeafChart chart(Triangles triangles, const std::shared_ptr<AlphaMask>& mask) const;

  void sort_solids();

  const SheetCollector* known_;
  std::int32_t solid_ = -1;
  std::shared_ptr<LeafSet::Sheets> sheets_ = std::make_shared<LeafSet::Sheets>();
  Charts charts_;
};

}  // namespace leafhull
