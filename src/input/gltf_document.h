// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace leafhull {

/// Parses the JSON of a glTF file and checks what tinygltf does not: the version, the nesting, the
/// required extensions, and every index, count and offset. Removes what leafhull does not read.
/// @throws Error input.
nlohmann::json parse_document(std::string_view text, const std::string& file);

}  // namespace leafhull
