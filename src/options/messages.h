// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace leafhull {

/// The fewest digits that give the same number back.
std::string number_text(double value);

/// @throws Error usage.
[[noreturn]] void refuse_option(const std::string& message, const std::string& remedy);

}  // namespace leafhull
