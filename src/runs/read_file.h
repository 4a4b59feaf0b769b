// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "leafhull/error.h"

namespace leafhull {

/// Hands over all that is left to read, piece by piece. Returns errno where that fails, otherwise
/// 0.
int read_rest(int descriptor, const std::function<void(std::string_view)>& take);

/// Hands over a file's content, piece by piece. @throws Error `code`: it cannot be read.
void read_file(const std::filesystem::path& file, ErrorCode code,
               const std::function<void(std::string_view)>& take);

/// A whole file. @throws Error input: it cannot be read.
std::string content_of(const std::filesystem::path& file);

}  // namespace leafhull
