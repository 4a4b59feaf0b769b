// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "leafhull/error.h"

namespace leafhull {

/// The error for a file that could not be written; `reason` is an errno value.
Error write_error(const std::filesystem::path& file, int reason);

}  // namespace leafhull
