// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "density/spatial_hash.h"
#include "leafhull/shape.h"
#include "pipeline/stage_options.h"

namespace leafhull {

/// Bytes that this process may still take: the machine's available memory, its control group's
/// limit or its address-space limit, whichever is least.
std::uint64_t available_memory();

/// Bytes of this process that are in memory now.
std::uint64_t resident_memory();
/// The most bytes of this process that were in memory at any time.
std::uint64_t peak_memory();

/// Estimates the memory of a field for all `thresholds`, ascending, and its mesh before they are
/// allocated, from the bricks that a coarse lattice would evaluate.
class FieldMemory {
 public:
  FieldMemory(std::span<const Kernel> kernels, std::shared_ptr<const SpatialHash> hash,
              const Box& bounds, const Grid& grid, const FieldOptions& options,
              std::span<const double> thresholds, std::uint64_t available);

  bool fits() const { return needed_ <= available_; }

  /// @throws Error usage: it does not fit; says how much is needed and the largest resolution that
  ///         fits.
  void check() const;

 private:
  int resolution_;
  double power_;               ///< the power of the resolution with which samples grow
  double needed_, available_;  ///< bytes
};

}  // namespace leafhull
