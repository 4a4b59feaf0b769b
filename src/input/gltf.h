// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "input/file_bytes.h"
#include "leafhull/tree.h"

namespace leafhull {

/// Reads glTF 2.0 from memory, text or binary.
/// @param name   as messages call the file.
/// @param folder where external buffers and images lie; empty: none are read.
/// @throws Error input.
TreeModel read_gltf(ByteSpan bytes, const std::string& name,
                    const std::optional<std::filesystem::path>& folder);

}  // namespace leafhull
