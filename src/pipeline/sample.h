// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "pipeline/evaluate.h"
#include "pipeline/memory.h"
#include "pipeline/prepared.h"
#include "pipeline/run.h"

namespace leafhull {

/// Step 6 of Figure 8: N where a surface can be.
struct Sampled {
  Field field;                               ///< its own threshold is the lowest
  std::uint64_t pairs = 0;                   ///< kernel-sample pairs evaluated
  std::shared_ptr<DensityFunction> density;  ///< the density that was sampled
};

/// The memory that sample() would take.
FieldMemory field_memory(const Run& run, const Prepared& prepared,
                         std::span<const double> thresholds);

/// Samples the density for all of `thresholds`, ascending.
/// @throws Error usage: it does not fit in memory.
Sampled sample(const Run& run, const Prepared& prepared, const std::vector<double>& thresholds,
               DensityFunction::Lists lists = DensityFunction::Lists::forget);

/// The field as step 7 needs it, with hollows filled if the options say so.
Field without_hollows(const Run& run, const Prepared& prepared, Field field);

}  // namespace leafhull
