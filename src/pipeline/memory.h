// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "density/spatial_hash.h"
#include "leafhull/options.h"
#include "leafhull/shape.h"

namespace leafhull {

/// Bytes that this process may still take: the machine's available memory, its control group's
/// limit or its address-space limit, whichever is least.
std::uint64_t available_memory();

/// Refuses a resolution whose field and mesh would not fit, before they are allocated. What they
/// need is judged from the bricks that a coarse lattice would evaluate.
/// @throws Error usage: how much is needed and the largest resolution that fits.
void check_memory(std::span<const Kernel> kernels, std::shared_ptr<const SpatialHash> hash,
                  const Box& bounds, const Report& report, std::uint64_t available);

}  // namespace leafhull
