// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace leafhull {

/// @throws Error usage.
[[noreturn]] void refuse_option(const std::string& message, const std::string& remedy);

}  // namespace leafhull
