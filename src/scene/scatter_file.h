// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <istream>

#include "leafhull/scene.h"

namespace leafhull {

/// @throws Error input: the file, the line and what is wrong.
Scene read_csv_scene(const std::filesystem::path& file);
Scene read_jsonl_scene(const std::filesystem::path& file);

/// As read_csv_scene, for text that stands for a file at that place.
Scene read_csv_text(std::istream& text, const std::filesystem::path& file);

}  // namespace leafhull
