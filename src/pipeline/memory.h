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
/// The most that there were.
std::uint64_t peak_memory();

/// What a field for all `thresholds`, ascending, and its mesh would take, told before they are
/// allocated: judged from the bricks that a coarse lattice would evaluate.
class FieldMemory {
 public:
  FieldMemory(std::span<const Kernel> kernels, std::shared_ptr<const SpatialHash> hash,
              const Box& bounds, const Grid& grid, const FieldOptions& options,
              std::span<const double> thresholds, std::uint64_t available);

  bool fits() const { return needed_ <= available_; }

  /// @throws Error usage where it does not fit: how much is needed and the largest resolution that
  ///         fits.
  void check() const;

 private:
  int resolution_;
  double power_;               ///< with which the samples grow with the resolution
  double needed_, available_;  ///< bytes
};

}  // namespace leafhull
