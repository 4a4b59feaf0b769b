// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "density/field.h"

namespace leafhull {

/// The field with its hollows raised to inside. A hollow is space below T that cannot be reached
/// from outside along lattice edges; islands of surface within it are inside anyway. Samples that
/// touch only across a diagonal are not connected, as in the meshers. A field without hollows comes
/// back unchanged and shares its grid. SPEC: 5.
Field fill_hollows(Field field);

}  // namespace leafhull
