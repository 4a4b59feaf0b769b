// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "density/field.h"

namespace leafhull {

/// The field with its hollows inside: what is below T and cannot be reached from outside along
/// lattice edges, islands of surface within counted as what they are, inside. Samples that touch
/// across a diagonal are not connected, as the meshers have it. A field without hollows comes back
/// as it is, its grid with it. SPEC: 5.
Field fill_hollows(Field field);

}  // namespace leafhull
