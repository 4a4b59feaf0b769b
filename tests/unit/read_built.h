// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "glb_builder.h"
#include "input/gltf.h"

namespace leafhull::test {

inline TreeModel read(const GlbBuilder& builder) { return read_gltf(builder.glb(), "t.glb", {}); }

}  // namespace leafhull::test
