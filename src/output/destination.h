// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace leafhull {

/// The absolute path, free of symbolic links, of the regular file that writing to `name` would
/// create or replace; it need not exist yet.
/// @throws Error output: its folder does not exist or is not writable.
std::filesystem::path resolve_destination(const std::filesystem::path& name);

}  // namespace leafhull
