// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "input/companions.h"
#include "input/file_bytes.h"
#include "leafhull/tree.h"

namespace leafhull {

/// Whether bytes are an FBX file, binary or ASCII.
bool looks_like_fbx(ByteSpan bytes);

/// Which way up an FBX file is taken to be.
enum class Axes { as_it_says, as_they_are };

/// Reads FBX from memory, in metres, posed as it is at rest. Vertex colours paint what has no
/// texture; beside one they are an exporter's data.
/// @param name as messages call the file; @param companions textures.
/// @throws Error input: it is no FBX file that can be read, or leafhull was built without ufbx.
TreeModel read_fbx(ByteSpan bytes, const std::string& name, const Companions& companions,
                   Axes axes);

}  // namespace leafhull
