// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "input/fbx.h"

namespace leafhull {

/// As read_fbx.
TreeModel read_fbx_file(ByteSpan bytes, const std::string& name, const Companions& companions,
                        Axes axes);

}  // namespace leafhull
