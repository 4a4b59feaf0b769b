// SPDX-License-Identifier: Apache-2.0
#include "pipeline/sample.h"

#include <utility>

#include "surface/hollows.h"

namespace leafhull {

FieldMemory field_memory(const Run& run, const Prepared& prepared,
                         std::span<const double> thresholds) {
  return {*prepared.kernels, prepared.hash, run.leaves.bounds, prepared.grid,
          prepared.field,    thresholds,    available_memory()};
}

Sampled sample(const Run& run, const Prepared& prepared, const std::vector<double>& thresholds,
               DensityFunction::Lists lists) {
  run.watch.start("field");
  field_memory(run, prepared, thresholds).check();
  const FieldOptions& options = prepared.field;
  const auto density = std::make_shared<DensityFunction>(
      run.device, *prepared.kernels, prepared.hash,
      Lattice::near(run.leaves.crown.low, options.voxel_size), options.kernels.density.falloff);
  DensityFunction::Sampled sampled =
      density->sample_band(thresholds, options.margin, options.dense, lists,
                           [&](double done) { run.watch.advance(done); });
  return {std::move(sampled.field), sampled.pairs, density};
}

Field without_hollows(const Run& run, const Prepared& prepared, Field field) {
  if (prepared.options.hollows == Hollows::keep) return field;
  run.watch.start("hollows");
  return fill_hollows(std::move(field));
}

}  // namespace leafhull
