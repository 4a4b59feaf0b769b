// SPDX-License-Identifier: Apache-2.0
#include "pipeline/direct_surface.h"

#include <algorithm>
#include <utility>

#include "leafhull/error.h"
#include "pipeline/describe.h"
#include "pipeline/sliders.h"
#include "surface/brick_mesher.h"
#include "surface/mesh_components.h"

namespace leafhull {
namespace {

bool reaches(const Field& field) {
  return static_cast<double>(field.highest()) >= field.threshold() || !field.inside().empty();
}

}  // namespace

struct DirectSurface::Impl {
  /// Holds the kernels and lists that the caster reads; only for a tree.
  std::shared_ptr<DensityFunction> density;
  Report report;
  std::shared_ptr<const Field> field;
  std::optional<BrickGrid> grid;
  std::optional<RayCaster> caster;
};

DirectSurface::DirectSurface(const LeafSet& leaves, const Options& options, Device& device,
                             const Progress& progress)
    : impl_(std::make_unique<Impl>()) {
  const ThreadLimit limit(device.threads());
  Stopwatch watch(progress);
  const Run run{leaves, device, watch, Detail::shape};
  Stages stages(run);
  Options resolved = resolve(options);
  resolved.adaptivity = 0;  // it concerns meshes only, and would widen the band of samples
  resolved.mesher = Mesher::bricks;
  Sliders sliders(run, stages, resolved);

  Prepared prepared = sliders.prepare();
  std::optional<Pieces> pieces;  // those by which an erosion was measured
  Sampled sampled;
  constexpr auto kKeep = DensityFunction::Lists::keep;
  if (resolved.erosion) {
    SampledSurface surface = sliders.surface(prepared, kKeep);
    sampled = std::move(surface.sampled);
    pieces = std::move(surface.pieces);
    pieces->polygons = {};
  } else {
    sampled = sample(run, prepared, {prepared.threshold}, kKeep);
    sampled.field = without_hollows(run, prepared, std::move(sampled.field));
  }
  if (!reaches(sampled.field)) {
    refuse_empty(prepared, *stages.there(prepared), sampled.field);
  }

  Impl& d = *impl_;
  d.report = describe(run, prepared);
  if (pieces) describe_pieces(*pieces, d.report);
  d.density = std::move(sampled.density);
  d.field = std::make_shared<const Field>(std::move(sampled.field));
  watch.start("bricks");
  d.grid.emplace(*d.field);
  if (const double smallest = *resolved.min_component; smallest > 0) {
    // As for a mesh, the lattice separates the pieces; its polygons are not kept.
    const ComponentCells cells = cells_of_components(mesh_bricks(*d.field), smallest);
    d.grid->draw_only(cells.kept, cells.dropped);
  }
  d.caster.emplace(device, *d.grid, prepared.threshold, d.density->kernels(), *d.density->lists(),
                   resolved.falloff);
  d.report.seconds = watch.finish();
}

DirectSurface::DirectSurface(std::shared_ptr<const Field> field, Device& device)
    : impl_(std::make_unique<Impl>()) {
  Impl& d = *impl_;
  d.field = std::move(field);
  if (!reaches(*d.field)) {
    throw Error(ErrorCode::empty, "the surface is empty: no sample reaches the threshold",
                "Lower --threshold.");
  }
  d.report.threshold = d.field->threshold();
  d.report.voxel_size = d.field->lattice().voxel_size;
  d.grid.emplace(*d.field);
  d.caster.emplace(device, *d.grid, d.field->threshold());
}

DirectSurface::~DirectSurface() = default;
DirectSurface::DirectSurface(DirectSurface&&) noexcept = default;

RayCaster& DirectSurface::caster() const { return *impl_->caster; }
const Lattice& DirectSurface::lattice() const { return impl_->field->lattice(); }
const Report& DirectSurface::report() const { return impl_->report; }

}  // namespace leafhull
