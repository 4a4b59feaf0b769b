// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "density/field.h"

namespace leafhull::bench {

/// How many pairs of a kernel and an evaluated sample of `field` have xi < 1, recounted on the host
/// in doubles.
std::uint64_t pairs_inside(std::span<const Kernel> kernels, const Field& field);

/// The same of kernels and leaf vertices.
std::uint64_t pairs_inside(std::span<const Kernel> kernels, std::span<const LeafVertex> leaves);

/// How many pairs the engine evaluates to sum `kernels` at the leaf vertices. `radius_max`: model
/// units. `falloff`: k.
std::uint64_t pairs_evaluated(std::span<const Kernel> kernels, const LeafSet& leaves,
                              double radius_max, int falloff);

}  // namespace leafhull::bench
