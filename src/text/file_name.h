// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace leafhull {

/// ".png" of FILE.PNG.
std::string lower_extension(const std::filesystem::path& file);

/// Whether a word, where it is no name of something else, was meant to be a file's.
bool looks_like_file(const std::string& word);

}  // namespace leafhull
