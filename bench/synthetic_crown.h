// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "leafhull/tree.h"

namespace leafhull::bench {

/// A crown of `leaf_vertices` / 4 quads of one size, scattered along twigs inside an ellipsoid
/// whose volume grows with their number, so that its mean density does not. It is the same on every
/// machine.
/// @throws Error usage where `leaf_vertices` is not a multiple of four.
TreeModel synthetic_crown(std::size_t leaf_vertices);

}  // namespace leafhull::bench
