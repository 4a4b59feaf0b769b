// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "input/companions.h"
#include "input/file_bytes.h"
#include "leafhull/tree.h"

namespace leafhull {

/// Whether bytes are an FBX file, binary or ASCII.
bool looks_like_fbx(ByteSpan bytes);

/// Whether the axes of an FBX file are converted as it says or kept as they are.
enum class Axes { as_it_says, as_they_are };

/// Reads FBX from memory, in metres, in its rest pose. Vertex colours are used only without a
/// texture; beside one they are some exporter's data.
/// @param name the file's name in messages; @param companions textures.
/// @throws Error input: it is no FBX file that can be read, or leafhull was built without ufbx.
TreeModel read_fbx(ByteSpan bytes, const std::string& name, const Companions& companions,
                   Axes axes);

}  // namespace leafhull
