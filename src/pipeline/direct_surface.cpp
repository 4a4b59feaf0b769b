// SPDX-License-Identifier: Apache-2.0
#include "pipeline/direct_surface.h"

#include <algorithm>
#include <utility>

#include "leafhull/error.h"
#include "pipeline/stages.h"
#include "pipeline/thread_limit.h"
#include "surface/brick_mesher.h"
#include "surface/components.h"

namespace leafhull {
namespace {

bool reaches(const Field& field) {
  return static_cast<double>(field.highest()) >= field.threshold() || !field.inside().empty();
}

}  // namespace

struct DirectSurface::Impl {
  Progress progress;
  Stopwatch watch{progress};
  /// Of a tree: keep the kernels and lists that the caster reads.
  std::optional<Stages> stages;
  Report report;
  std::shared_ptr<const Field> field;
  std::optional<BrickGrid> grid;
  std::optional<RayCaster> caster;
};

DirectSurface::DirectSurface(const LeafSet& leaves, const Options& options, Device& device,
                             const Progress& progress)
    : impl_(std::make_unique<Impl>()) {
  const ThreadLimit limit(device);
  Impl& d = *impl_;
  d.progress = progress;
  Stages& stages = d.stages.emplace(leaves, device, d.watch, Stages::Lists::keep);
  d.report.options = resolve(options);
  d.report.options.adaptivity = 0;  // it is of meshes, and widens what is sampled
  stages.prepare(d.report);
  if (d.report.options.erosion) {
    d.field = std::make_shared<const Field>(stages.surface(d.report, Mesher::bricks).field);
  } else {
    stages.sample(d.report, {d.report.threshold});
    d.field = std::make_shared<const Field>(stages.take_field(d.report));
  }
  const Field& field = *d.field;
  if (!reaches(field)) stages.refuse_empty(field, d.report);

  d.watch.start("bricks");
  d.grid.emplace(field);
  if (const double smallest = *d.report.options.min_component; smallest > 0) {
    // The lattice tells the pieces apart, as for a mesh; its polygons are not kept.
    const ComponentCells cells = cells_of_components(mesh_bricks(field), smallest);
    d.grid->draw_only(cells.kept, cells.dropped);
  }
  d.caster.emplace(device, *d.grid, d.report.threshold, stages.density().kernels(), *stages.lists(),
                   d.report.options.falloff);
  d.report.seconds = d.watch.finish();
  d.progress = {};
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
