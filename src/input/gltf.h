// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "input/companions.h"
#include "input/file_bytes.h"
#include "leafhull/tree.h"

namespace leafhull {

/// Reads glTF 2.0 from memory, text or binary.
/// @param name the file's name in messages.
/// @param companions external buffers and images.
/// @throws Error input.
TreeModel read_gltf(ByteSpan bytes, const std::string& name, const Companions& companions);

}  // namespace leafhull
