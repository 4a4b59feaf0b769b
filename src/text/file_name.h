// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace leafhull {

/// The extension in lower case: ".png" for FILE.PNG.
std::string lower_extension(const std::filesystem::path& file);

/// Whether a word that names nothing else was probably meant as a file name.
bool looks_like_file(const std::string& word);

}  // namespace leafhull
